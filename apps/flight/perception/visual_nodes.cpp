// SPDX-License-Identifier: BSD-3-Clause
// tested-in: perception_nodes
#include "flyball/flight/perception/visual_nodes.h"

namespace flyball {
namespace {

void add_see(Graph& graph, Topic<View> view, Topic<VisualFix> fix, MissionContext& context) {
  NodeSpec spec;
  spec.name = "see";
  spec.cost = frame_cost(context.settings.kernels.localizer);
  spec.trigger = OnMessage{view.index};
  spec.priority =
      28;  // Before points and map: where nobody knows the pose, a map is worth nothing.
  spec.writes = {fix.index};
  graph.node(std::move(spec), [view, fix, &context](JobContext& job) {
    Work work;
    const auto seen = job.latest(view);
    if (!seen) {
      return work;
    }
    const auto found = context.kernels.localizer->see(visual_frame(*seen), work);
    if (found) {
      job.publish(fix, *found);
    } else {
      context.event(job.now(), "frame not localized: " + found.error().message);
    }
    return work;
  });
}

void add_correct(Graph& graph, Topic<VisualFix> fix, MissionContext& context) {
  NodeSpec spec;
  spec.name = "correct";
  spec.trigger = OnMessage{fix.index};
  spec.priority = 31;
  graph.node(std::move(spec), [fix, &context](JobContext& job) {
    const auto found = job.latest(fix);
    if (!found) {
      return Work{};
    }
    LocalizationWatch& watch = context.localization;
    const bool was_lost = watch.is_lost();
    watch.fixed(job.now(), *found);
    if (was_lost != watch.is_lost()) {
      context.event(job.now(), was_lost ? "localized again" : "localization lost");
    }
    context.kernels.localizer->correct(*found);
    if (watch.has_given_up(job.now())) {
      context.finish(job.now(), MissionStatus::failed, MissionFailure::localization_lost);
    }
    return Work{};
  });
}

}  // namespace

void add_sight(Graph& graph, MissionContext& context) {
  if (!context.has_rgb_camera) {
    return;
  }
  context.view = graph.topic<View>("view");
  const auto fix = graph.topic<VisualFix>("fix");
  add_see(graph, *context.view, fix, context);
  add_correct(graph, fix, context);
}

}  // namespace flyball
