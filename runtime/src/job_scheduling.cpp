// SPDX-License-Identifier: BSD-3-Clause
//
// Everything that may change who runs asks for a dispatch, which comes once, behind all that
// happens at the same moment; so a job never starts before a more urgent one that was released
// with it, and it reads all messages of that moment.

#include "flyball/runtime/assert.h"
#include "flyball/runtime/realtime/cpu_time.h"

#include "core_shares.h"
#include "virtual_computer.h"
#include <algorithm>
#include <functional>
#include <numeric>
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
  send_inputs();
  serve(ComputePlace::board, queue.now() < stalled_until ? 0.0 : free_cores());
  serve_gpu();
  if (edge) {
    serve(ComputePlace::edge, edge->model.point.cores);
  }
}

void VirtualComputer::serve(ComputePlace place, double cores) {
  const std::vector<int> urgent = nodes_by_urgency(place);
  std::vector<double> shares = shares_of(urgent, cores);
  // A job that has computed may leave cores to others: only then it is known what they would bring.
  while (compute_new(urgent, shares)) {
    shares = shares_of(urgent, cores);
  }
  const double busy = (place == ComputePlace::board ? taken_cores : 0.0) +
                      std::accumulate(shares.begin(), shares.end(), 0.0);
  for (std::size_t i = 0; i < urgent.size(); ++i) {
    const int node = urgent[i];
    if (!has_moved(node)) {
      const Job& job = *nodes[index(node)].job;
      apply_share(node, shares[i],
                  platform_of(node).slowdown(price_list(node, job.record.work), clock_of(place),
                                             busy - shares[i]));
    }
  }
}

std::vector<double> VirtualComputer::shares_of(const std::vector<int>& urgent, double cores) const {
  std::vector<CoreClaim> first;
  std::vector<CoreClaim> more;
  for (const int node : urgent) {
    first.push_back({spec(node).priority, 1.0});
    more.push_back({spec(node).priority, useful_cores(node) - 1.0});
  }
  // A second core only makes a job faster; to another job it may be the only one.
  std::vector<double> shares = share_cores(first, cores);
  const double left = cores - std::accumulate(shares.begin(), shares.end(), 0.0);
  const std::vector<double> idle = share_cores(more, std::max(0.0, left));
  std::transform(shares.begin(), shares.end(), idle.begin(), shares.begin(), std::plus<>{});
  return shares;
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

/// One job at a time: the most urgent of those that wait. It is not interrupted.
void VirtualComputer::serve_gpu() {
  const std::vector<int> urgent = nodes_by_urgency(ComputePlace::gpu);
  if (urgent.empty()) {
    return;
  }
  const auto running = std::find_if(urgent.begin(), urgent.end(), [this](int node) {
    return nodes[index(node)].job->share > 0.0;
  });
  const int next = running != urgent.end() ? *running : urgent.front();
  if (!nodes[index(next)].job->has_started) {
    compute(next);
  }
  if (!has_moved(next)) {
    apply_share(next, 1.0);
  }
}

bool VirtualComputer::has_moved(int node) {
  Job& job = *nodes[index(node)].job;
  if (!job.has_started || job.place == ComputePlace::edge) {
    return false;
  }
  const ComputePlace place = platform.runs_on_gpu(price_list(node, job.record.work))
                                 ? ComputePlace::gpu
                                 : ComputePlace::board;
  if (place == job.place) {
    return false;
  }
  job.place = place;
  request_dispatch();
  return true;
}

bool VirtualComputer::is_gpu_busy() const {
  return std::any_of(nodes.begin(), nodes.end(), [](const NodeState& node) {
    return node.job && node.job->place == ComputePlace::gpu && node.job->share > 0.0;
  });
}

std::vector<int> VirtualComputer::nodes_by_urgency(ComputePlace place) const {
  std::vector<int> urgent;
  for (int node = 0; node < static_cast<int>(nodes.size()); ++node) {
    const auto& job = nodes[index(node)].job;
    if (job && job->place == place && !job->is_in_transit) {
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
  if (!(speed_on(node, 2.0) > 1.0)) {
    return 1.0;
  }
  const std::optional<int> threads = nodes[index(node)].job->record.work.threads();
  return std::min(spec(node).threads, threads.value_or(spec(node).threads));
}

// Of a job that has not computed yet, nobody knows how much of it is shared.
double VirtualComputer::speed_on(int node, double cores) const {
  const std::optional<Job>& job = nodes[index(node)].job;
  const bool is_known = job && job->has_started;
  const double together = platform_of(node).speedup(
      is_known ? price_list(node, job->record.work) : spec(node).cost, cores);
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
  job.record.host_s = to_seconds(thread_cpu_time() - begin + take_helpers_time());
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

Hertz VirtualComputer::clock_of(ComputePlace place) const {
  return place == ComputePlace::edge ? edge->model.point.frequency : point.frequency;
}

const Platform& VirtualComputer::platform_of(int node) const {
  return nodes[index(node)].job->place == ComputePlace::edge ? *edge->model.platform : platform;
}

const std::string& VirtualComputer::price_list(int node, const Work& work) const {
  return work.charged_as().empty() ? spec(node).cost : work.charged_as();
}

Duration VirtualComputer::time_on_one_core(int node, const Work& work) const {
  const std::string& kernel = price_list(node, work);
  if (kernel.empty()) {
    return Duration::zero();
  }
  return nodes[index(node)].job->place == ComputePlace::edge
             ? edge->job_time(kernel, work)
             : platform.job_time(kernel, work, point.frequency);
}

void VirtualComputer::apply_share(int node, double share, double slowdown) {
  Job& job = *nodes[index(node)].job;
  const double undisturbed = share <= 1.0 ? share : speed_on(node, share);
  const double speed = undisturbed / slowdown;
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
  busy_gpu_s += is_gpu_busy() ? elapsed_s : 0.0;
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

/// Of the whole computer on board.
double VirtualComputer::busy_cores() const {
  double sum = taken_cores;
  for (const NodeState& node : nodes) {
    sum += node.job && node.job->place == ComputePlace::board ? node.job->share : 0.0;
  }
  return sum;
}

void VirtualComputer::rescale_running_jobs() {
  for (int node = 0; node < static_cast<int>(nodes.size()); ++node) {
    auto& job = nodes[index(node)].job;
    if (job && job->has_started && job->place != ComputePlace::edge) {
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
