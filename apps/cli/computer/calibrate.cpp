// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/records/report.h"
#include "flyball/records/text_table.h"
#include "flyball/runtime/board/clock_meter.h"
#include "flyball/studies/calibration.h"
#include "flyball/studies/heat_measurement.h"
#include "flyball/studies/power_measurement.h"

#include "cli/commands.h"
#include "cli/computer/real_computer.h"
#include "cli/console.h"
#include "cli/flight_options.h"
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <thread>
#include <utility>

#include <CLI/CLI.hpp>

namespace flyball {
namespace {

struct CalibrateArguments {
  std::string out{};
  std::string like{"jetson_tx2"};
  std::string board{};
  double flight_s{20.0};
  double heat_s{180.0};
  bool sets_clocks{};
};

/// This computer, as far as a calibration has to do with it. Null board: it cannot be opened, and
/// what is measured is the kernels' times at the present clock.
struct Bench {
  std::unique_ptr<LinuxSystem> system{linux_system()};
  BoardFile file{};
  std::unique_ptr<LinuxBoard> board{};
  std::string no_board{};  ///< Why there is none.
  std::vector<std::string> remarks{};
  std::chrono::steady_clock::time_point begun{std::chrono::steady_clock::now()};
};

Result<Bench> open_bench(const CalibrateArguments& given) {
  Bench bench;
  auto file = choose_board(given.board, discover_board(*bench.system).model);
  if (!file) {
    return file.error();
  }
  bench.file = *file;
  LinuxBoardOptions options;
  options.file = *file;
  auto opened = LinuxBoard::open(*bench.system, options);
  if (opened) {
    bench.board = std::move(*opened);
  } else if (given.sets_clocks) {
    return opened.error();
  } else {
    bench.no_board = opened.error().message;
  }
  return bench;
}

/// Asks for a clock and believes what was measured.
Status set_clock(Bench& bench, Hertz wanted) {
  using namespace std::chrono_literals;
  bench.board->request({static_cast<int>(bench.board->active_cpus().size()), wanted});
  std::this_thread::sleep_for(50ms);  // Chosen: longer than any driver's transition.
  const Hertz granted = clock_by_additions(bench.file.cycles_per_addition);
  constexpr double tolerance = 0.05;
  if (std::abs(granted.value() / wanted.value() - 1.0) <= tolerance) {
    return Done{};
  }
  return Error{ErrorCode::unavailable, "a clock of " + rounded(1e-9 * wanted.value(), 3) +
                                           " GHz was asked for, and " +
                                           rounded(1e-9 * granted.value(), 3) + " GHz came"};
}

/// Those that can really be had, ascending.
std::vector<Hertz> settable_clocks(Bench& bench) {
  std::vector<Hertz> clocks;
  for (const Hertz clock : bench.board->model().frequencies) {
    const Status set = set_clock(bench, clock);
    if (set) {
      clocks.push_back(clock);
    } else {
      bench.remarks.push_back(set.error().message + "; it is left out");
    }
  }
  return clocks;
}

ClockChoice clocks_of(Bench& bench, const CalibrateArguments& given) {
  ClockChoice choice;
  constexpr double step_hz = 1e6;  // The measurement knows no more.
  const Hertz measured = clock_by_additions(bench.file.cycles_per_addition);
  choice.current = Hertz{step_hz * std::round(measured.value() / step_hz)};
  if (!given.sets_clocks) {
    bench.remarks.push_back("The clock was left as it was, at " +
                            rounded(1e-9 * choice.current.value(), 2) +
                            " GHz as measured; how times depend on it is the old file's (a, b).");
    return choice;
  }
  choice.settable = settable_clocks(bench);
  choice.set = [&bench](Hertz clock) { return set_clock(bench, clock); };
  if (choice.settable.empty()) {
    bench.remarks.emplace_back(
        "No clock can be set here; how times depend on it is the old "
        "file's (a, b).");
    for (const std::string& why : bench.board->notes()) {
      remark(why);
    }
  }
  return choice;
}

bool has_power_meter(const Bench& bench) {
  return bench.board != nullptr && bench.board->power_source() != "none";
}

/// All meters, now. One beginning for all looks: the board's meters average over time.
BoardReading look(const Bench& bench) {
  bench.board->refresh(std::chrono::steady_clock::now() - bench.begun);
  return bench.board->read();
}

/// The model's power, where the board has a meter.
Status calibrate_power(Bench& bench, const ClockChoice& clock, PlatformModel& model) {
  if (!has_power_meter(bench)) {
    bench.remarks.push_back("Power was not measured, because " +
                            (bench.board ? std::string{"the board has no meter"} : bench.no_board) +
                            "; it is " + model.name + "'s.");
    return Done{};
  }
  PowerMeasurement how;
  how.clocks = clock.settable.empty() ? std::vector<Hertz>{clock.current} : clock.settable;
  how.set = clock.settable.empty() ? nullptr : clock.set;
  how.cpus = cores_for_jobs(bench.file);
  how.meter = [&bench] { return look(bench).computer_power; };
  const auto samples = measure_power(how);
  if (!samples) {
    return samples.error();
  }
  model.power = fitted_power(*samples);
  double worst = 0.0;
  for (const MeasuredPower& one : *samples) {
    const double modeled_w = model.power.power(one.clock, one.busy_cores).value();
    worst = std::max(worst, std::abs(modeled_w / one.power.value() - 1.0));
  }
  bench.remarks.push_back("Power was measured by " + bench.board->power_source() + ", " +
                          std::to_string(samples->size()) +
                          " points; the model is off by at most " + rounded(100.0 * worst, 1) +
                          " %.");
  return Done{};
}

/// What is measured: all cores busy at the clock at which power was measured last, the highest.
HeatMeasurement heat_measurement(const Bench& bench, const CalibrateArguments& given) {
  HeatMeasurement how;
  how.cpus = cores_for_jobs(bench.file);
  how.phase = from_seconds(given.heat_s);
  how.stop = was_interrupted;
  how.meter = [&bench] {
    const BoardReading reading = look(bench);
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - bench.begun;
    return HeatSample{passed.count(), reading.computer_power, reading.temperature_c};
  };
  return how;
}

/// The model's heat, where the board has a meter of its power and a sensor.
Status calibrate_heat(Bench& bench, const CalibrateArguments& given, PlatformModel& model) {
  const std::string old = model.thermal ? "; it is " + model.name + "'s." : ".";
  if (given.heat_s == 0.0 || !has_power_meter(bench) || bench.board->read().temperature_c == 0.0) {
    bench.remarks.push_back("Heat was not measured, " +
                            std::string{given.heat_s == 0.0
                                            ? "as asked"
                                            : "which takes a power meter and a thermal zone"} +
                            old);
    return Done{};
  }
  if (has_watcher()) {
    note("heat: all cores busy, then idle, " + rounded(given.heat_s, 0) + " s each");
  }
  const auto samples = measure_heat(heat_measurement(bench, given));
  if (!samples) {
    return samples.error();
  }
  const auto fit = fitted_heat(*samples);
  if (!fit) {
    bench.remarks.push_back("Heat is not known: " + fit.error().message + old);
    return Done{};
  }
  ThermalModel heat = fit->model;
  if (model.thermal) {
    heat.trips = model.thermal->trips;
  }
  bench.remarks.push_back(
      "Heat was measured: " + rounded(heat.resistance_k_w, 2) + " K/W to air of " +
      rounded(heat.ambient_c, 0) + " degrees Celsius, within " + rounded(fit->worst_k, 1) +
      " K; where clocks are lost is " + (heat.trips.empty() ? "not known." : model.name + "'s."));
  model.thermal = std::move(heat);
  return Done{};
}

CalibrationOptions options_of(const CalibrateArguments& given,
                              const Bench& bench,
                              const ClockChoice& clock) {
  CalibrationOptions options;
  options.like = given.like;
  options.draft = given.out + ".draft.toml";
  options.cores = static_cast<int>(cores_for_jobs(bench.file).size());
  options.flight_s = given.flight_s;
  options.clock = clock;
  options.stop = was_interrupted;
  if (has_watcher()) {
    options.progress = [](const std::string& what) { note(what); };
  }
  return options;
}

/// The file, and for a person what is in it.
Status write_platform(const std::string& out, Bench& bench, Calibration& calibration) {
  PlatformModel& model = calibration.model;
  bench.remarks.insert(bench.remarks.begin(),
                       "Made by flyball calibrate, like " + model.name + ".");
  bench.remarks.insert(bench.remarks.end(), calibration.left_out.begin(),
                       calibration.left_out.end());
  model.name = std::filesystem::path{out}.stem().string();
  if (Status written = write_file(out, to_toml(model, bench.remarks)); !written) {
    return written;
  }
  print(to_text(calibration));
  for (const std::string& remark : bench.remarks) {
    print(remark + "\n");
  }
  print("\nFly with it: flyball run delivery_forest --set platform.name=" + out +
        " --set platform.cores=" + std::to_string(model.max_cores) +
        " --set platform.frequency_hz=" + rounded(model.frequencies.back().value(), 0) + "\n");
  return Done{};
}

/// Kernels first, then power and heat; the board is as it was afterwards.
Result<Calibration> measure(const CalibrateArguments& given, Bench& bench) {
  const ClockChoice clock = clocks_of(bench, given);
  auto calibration = calibrate(options_of(given, bench, clock));
  if (!calibration) {
    return calibration;
  }
  if (const Status power = calibrate_power(bench, clock, calibration->model); !power) {
    return power.error();
  }
  if (const Status heat = calibrate_heat(bench, given, calibration->model); !heat) {
    return heat.error();
  }
  for (const Error& not_restored : bench.board ? bench.board->close() : std::vector<Error>{}) {
    remark(not_restored.message);
  }
  return calibration;
}

int calibrate_into(const CalibrateArguments& given) {
  if (std::filesystem::exists(given.out)) {
    return refuse({{ErrorCode::invalid_input,
                    "\"" + given.out + "\" exists; remove it, or give --out another name"}});
  }
  auto bench = open_bench(given);
  if (!bench) {
    return refuse({bench.error()});
  }
  auto calibration = measure(given, *bench);
  if (was_interrupted()) {
    note("interrupted; nothing is written");
    return interrupted_exit_code();
  }
  if (!calibration) {
    return refuse({calibration.error()});
  }
  const Status written = write_platform(given.out, *bench, *calibration);
  return written ? exit_success : refuse({written.error()});
}

}  // namespace

void add_calibrate(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand(
      "calibrate", "measures what kernels cost on this computer, and writes a platform file");
  const auto given = std::make_shared<CalibrateArguments>();  // Owners: the parser's callbacks.
  command->add_option("--out", given->out, "the platform file to write")
      ->type_name("FILE.toml")
      ->required()
      ->check([](const std::string& name) {
        return std::filesystem::path{name}.extension() == ".toml"
                   ? std::string{}
                   : "\"" + name + "\" does not end in .toml";
      });
  command
      ->add_option("--like", given->like,
                   "a platform whose kernels, and whatever is not measured, are taken over")
      ->type_name("PLATFORM")
      ->capture_default_str();
  refuse_nan(
      *command->add_option("--seconds", given->flight_s, "mission time of each of the flights")
           ->check(CLI::Range(2.0, 600.0))
           ->capture_default_str());
  refuse_nan(
      *command
           ->add_option("--heat-seconds", given->heat_s,
                        "how long all cores are kept busy, and then idle, to measure heat; 0: not")
           ->check(CLI::Range(0.0, 3600.0))
           ->capture_default_str());
  command->add_flag("--set-clocks", given->sets_clocks,
                    "measures at every clock that may be set, and restores it");
  refuse_empty(
      *command
           ->add_option(
               "--board", given->board,
               "a name from `flyball list boards`, if the model of this computer does not tell")
           ->type_name("NAME"));
  command->callback([given, &exit_code] {
    catch_interrupt();
    exit_code = calibrate_into(*given);
  });
}

}  // namespace flyball
