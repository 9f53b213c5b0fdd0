// SPDX-License-Identifier: BSD-3-Clause
//
// Everything that may change who runs asks for a dispatch, which comes once, behind all that
// happens at the same moment; so a job never starts before a more urgent one that was released
// with it, and it reads all messages of that moment.

#include "flyball/runtime/assert.h"

#include "core_shares.h"
#include "realtime/cpu_meter.h"
#include "virtual_computer.h"
#include <algorithm>
#include <utility>

namespace flyball {

void VirtualComputer::request_dispatch() {
  if (!is_dispatch_pending) {
    is_dispatch_pending = true;
    at(queue.now(), EventOrder::trigger, [](VirtualComputer& computer) { computer.dispatch(); });
  }
}

void VirtualComputer::dispatch() {
  is_dispatch_pending = false;
  advance();
  const std::vector<int> urgent = nodes_by_urgency();
  std::vector<double> shares = shares_of(urgent);
  // A job that has computed may leave cores to others: only then it is known what they would bring.
  while (compute_new(urgent, shares)) {
    shares = shares_of(urgent);
  }
  for (std::size_t i = 0; i < urgent.size(); ++i) {
    apply_share(urgent[i], shares[i]);
  }
}

std::vector<double> VirtualComputer::shares_of(const std::vector<int>& urgent) const {
  std::vector<CoreClaim> claims;
  claims.reserve(urgent.size());
  for (const int node : urgent) {
    claims.push_back({spec(node).priority, useful_cores(node)});
  }
  const bool is_stalled = queue.now() < stalled_until;
  return share_cores(claims, is_stalled ? 0.0 : free_cores());
}

bool VirtualComputer::compute_new(const std::vector<int>& urgent,
                                  const std::vector<double>& shares) {
  bool is_any = false;
  for (std::size_t i = 0; i < urgent.size(); ++i) {
    if (shares[i] > 0.0 && !nodes[index(urgent[i])].job->has_started) {
      compute(urgent[i]);
      is_any = true;
    }
  }
  return is_any;
}

std::vector<int> VirtualComputer::nodes_by_urgency() const {
  std::vector<int> urgent;
  for (int node = 0; node < static_cast<int>(nodes.size()); ++node) {
    if (nodes[index(node)].job) {
      urgent.push_back(node);
    }
  }
  std::sort(urgent.begin(), urgent.end(), [this](int a, int b) {
    return spec(a).priority != spec(b).priority ? spec(a).priority > spec(b).priority
                                                : nodes[index(a)].job->id < nodes[index(b)].job->id;
  });
  return urgent;
}

double VirtualComputer::useful_cores(int node) const {
  // A second core that brings nothing is left to others.
  return speed_on(node, 2.0) > 1.0 ? spec(node).threads : 1.0;
}

// Of a job that has not computed yet, nobody knows how much of it is shared.
double VirtualComputer::speed_on(int node, double cores) const {
  const std::optional<Job>& job = nodes[index(node)].job;
  const bool is_known = job && job->has_started;
  const double together =
      platform.speedup(is_known ? price_list(node, job->record.work) : spec(node).cost, cores);
  const double shared = is_known ? job->shared : 1.0;
  return together > 1.0 && shared < 1.0 ? 1.0 / (1.0 - shared + shared / together) : together;
}

void VirtualComputer::compute(int node) {
  NodeState& here = nodes[index(node)];
  Job& job = *here.job;
  job.has_started = true;
  job.record.started = queue.now();
  job.record.clock = point.frequency;
  NodeJob& context = here.context;
  context.renew();
  context.record.released = job.record.released;
  context.record.started = job.record.started;
  exchange.open(node, context);
  const Duration begin = thread_cpu_time();
  job.record.work = graph.nodes()[index(node)].body(context);
  job.record.host_s = to_seconds(thread_cpu_time() - begin);
  exchange.close(node, context);
  context.note_questions();
  job.record.reads = context.record.reads;
  job.record.questions_before_stop = context.record.questions_before_stop;
  job.outputs = std::move(context.outputs);
  job.at_end = std::move(context.last_actions);
  job.one_core_s = to_seconds(time_on_one_core(node, job.record.work));
  if (job.record.work.tells_shared()) {
    const double shared_s = to_seconds(time_on_one_core(node, job.record.work.shared()));
    job.shared = job.one_core_s > 0.0 ? shared_s / job.one_core_s : 0.0;
  }
}

const std::string& VirtualComputer::price_list(int node, const Work& work) const {
  return work.charged_as().empty() ? spec(node).cost : work.charged_as();
}

Duration VirtualComputer::time_on_one_core(int node, const Work& work) const {
  const std::string& kernel = price_list(node, work);
  return kernel.empty() ? Duration::zero() : platform.job_time(kernel, work, point.frequency);
}

void VirtualComputer::apply_share(int node, double share) {
  Job& job = *nodes[index(node)].job;
  const double speed = share <= 1.0 ? share : speed_on(node, share);
  if (job.has_end && speed == job.speed) {
    job.share = share;
    return;  // its end stays exactly where it is
  }
  job.share = share;
  job.speed = speed;
  job.has_end = false;
  ++job.end_schedule;
  if (job.speed > 0.0) {
    schedule_end(node);
  }
}

void VirtualComputer::schedule_end(int node) {
  Job& job = *nodes[index(node)].job;
  job.has_end = true;
  const auto end = [node, id = job.id, schedule = job.end_schedule](VirtualComputer& computer) {
    const auto& present = computer.nodes[index(node)].job;
    if (present && present->id == id && present->end_schedule == schedule) {
      computer.end_job(node);
    }
  };
  at(queue.now() + job.time_to_end(), EventOrder::job, end);
}

void VirtualComputer::advance() {
  const double elapsed_s = to_seconds(queue.now() - advanced_to);
  advanced_to = queue.now();
  if (elapsed_s <= 0.0) {
    return;
  }
  busy_core_s += busy_cores() * elapsed_s;
  busiest_core_s += std::min(1.0, busy_cores()) * elapsed_s;
  for (NodeState& node : nodes) {
    if (node.job && node.job->has_started) {
      node.job->advance(elapsed_s);
    }
  }
}

/// Somebody else's work goes first to the cores that this graph leaves idle, as an operating system
/// would place it; a core is left to the graph in any case.
double VirtualComputer::free_cores() const {
  const double idle = std::max(0, platform.max_cores() - point.cores);
  return std::max(std::min(1.0, static_cast<double>(point.cores)),
                  point.cores - std::max(0.0, taken_cores - idle));
}

/// Of the whole computer.
double VirtualComputer::busy_cores() const {
  double sum = taken_cores;
  for (const NodeState& node : nodes) {
    sum += node.job ? node.job->share : 0.0;
  }
  return sum;
}

void VirtualComputer::rescale_running_jobs() {
  for (int node = 0; node < static_cast<int>(nodes.size()); ++node) {
    auto& job = nodes[index(node)].job;
    if (job && job->has_started) {
      job->one_core_s = to_seconds(time_on_one_core(node, job->record.work));
      job->has_end = false;  // at the same share it still ends at another time
    }
  }
}

void VirtualComputer::set_operating_point(const OperatingPoint& wanted) {
  FLYBALL_ASSERT(wanted.cores >= 1 && wanted.frequency.value() > 0.0, "cores=%d, frequency=%g Hz",
                 wanted.cores, wanted.frequency.value());
  requested = wanted;
  advance();
  apply(platform.granted(requested));
}

void VirtualComputer::change_platform() {
  advance();  // At the rates that have been in force until now.
  taken_cores = platform.taken_cores();
  rescale_running_jobs();
  apply(platform.granted(requested));
}

void VirtualComputer::apply(const OperatingPoint& granted) {
  const bool changes_clock = granted.frequency != point.frequency;
  point = granted;
  if (changes_clock) {
    rescale_running_jobs();
    stalled_until = queue.now() + platform.switching_time();
    at(stalled_until, EventOrder::trigger,
       [](VirtualComputer& computer) { computer.request_dispatch(); });
  }
  request_dispatch();
}

}  // namespace flyball
