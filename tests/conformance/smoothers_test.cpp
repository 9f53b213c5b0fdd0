// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/kernels/conformance/smoother_conformance.h"

#include "kernel_trials.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// An honest smoother whose curve is spoilt.
class SmootherCulprit final : public Smoother {
 public:
  explicit SmootherCulprit(std::string crime) : crime_{std::move(crime)} {}

  Result<SmoothPath> smooth(const SmoothRequest& request, const OccupancyView& map) override {
    SmoothRequest asked = request;
    const DenseMap nothing{{{0, 0, 0}, {1, 1, 1}}, 0.15};
    if (crime_ == "credulous" && asked.waypoints_W.size() < 2) {
      asked = {{{0, 0, 2}, {1, 0, 2}}, Vec3::Zero(), 1.0, 1.0, request.body};
    } else if (crime_ == "reckless") {
      asked.max_acceleration_m_s2 *= 2.0;
    } else if (crime_ == "deaf") {
      asked.start_velocity_W = -asked.start_velocity_W;
    }
    const bool is_blind = crime_ == "blind" || crime_ == "cuts";
    auto smooth = honest_->smooth(asked, is_blind ? nothing : map);
    if (smooth && !smooth->trajectory.pieces.empty()) {
      spoil(*smooth);
    }
    return smooth;
  }

 private:
  static void hurry(Trajectory& curve, double factor) {
    for (PolynomialPiece& piece : curve.pieces) {
      piece.duration_s /= factor;
      for (int k = 0; k < 8; ++k) {
        piece.c.col(k) *= std::pow(factor, k);
      }
    }
  }

  void spoil(SmoothPath& smooth) {
    auto& pieces = smooth.trajectory.pieces;
    if (crime_ == "speeds") {
      hurry(smooth.trajectory, 2.0);
    } else if (crime_ == "jumps") {
      pieces.back().c(1, 1) += 1.0;
    } else if (crime_ == "elsewhere") {
      pieces.front().c(0, 0) += 0.1;
    } else if (crime_ == "cuts") {
      for (PolynomialPiece& piece : pieces) {  // Towards the inside of the bend.
        piece.c.row(1) *= 1.2;
      }
    } else if (crime_ == "runs_on") {
      pieces.resize(1);
      pieces[0].c.setZero();
      pieces[0].c(0, 1) = 1.0;
    } else if (crime_ == "idle") {
      smooth.work = {};
    } else if (crime_ == "shrinking") {
      const double count = smooth.work.count("pieces");
      smooth.work = {};
      smooth.work.add("pieces", 1e3 / count);
    } else if (crime_ == "remembers") {
      hurry(smooth.trajectory, 1.0 - 1e-9 * smoothed_++);
    }
  }

  std::string crime_;
  std::unique_ptr<Smoother> honest_{kit::kernels().make<Smoother>("minimum_snap")};
  int smoothed_{};
};

TEST(Smoothers, keep_their_contract) {
  kit::try_all_registered<SmootherConformance, Smoother>();
}

TEST(SmootherConformance, finds_each_kind_of_breach) {
  kit::expect_crimes_found<SmootherConformance, Smoother>(
      [](const std::string& crime) { return std::make_unique<SmootherCulprit>(crime); },
      {{"credulous", "accepts too few way-points"},
       {"reckless", "accelerates more than it may"},
       {"deaf", "does not begin in the direction of the start velocity"},
       {"blind", "does not refuse a polygon that collides"},
       {"cuts", "hits an obstacle"},
       {"speeds", "is faster than it may be"},
       {"jumps", "jumps between two pieces"},
       {"elsewhere", "does not lead from the first way-point to the last"},
       {"runs_on", "does not stop at its end"},
       {"idle", "counts no pieces"},
       {"shrinking", "counts less work for a larger input"},
       {"remembers", "answers differently after other requests"}});
}

}  // namespace
}  // namespace flyball
