// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Many missions whose results are kept in a store: only what is missing there flies.

#include "flyball/studies/flight_store.h"

#include "flight_batch.h"
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace flyball {

struct StoredFlight : PlannedFlight {
  std::string settings{};            ///< Of a sweep, as `FlightStore` wants them.
  std::optional<Summary> summary{};  ///< Empty until it has flown.
};

/// Those of a list whose elements are stored flights.
template <class Flight>
[[nodiscard]] std::vector<StoredFlight*> pointers_to(std::vector<Flight>& flights) {
  std::vector<StoredFlight*> pointers;
  pointers.reserve(flights.size());
  for (Flight& flight : flights) {
    pointers.push_back(&flight);
  }
  return pointers;
}

struct StoredBatch {
  std::string folder{};   ///< All flights' folders are in it.
  std::size_t jobs{1};    ///< At a time.
  bool keeps_records{};   ///< The whole record of each flight, not only its summary.
  bool shows_progress{};  ///< One line for each flight that has ended, with the time left.
};

/// Takes from the store what it knows, flies the rest, and adds it to the store one by one, so that
/// the same call goes on where it was interrupted.
[[nodiscard]] Flown fly_stored(const StoredBatch& batch,
                               FlightStore& store,
                               const std::vector<StoredFlight*>& flights);

/// Those that the store does not know; the others get their summaries.
/// @param with_records  Known is then only a flight whose whole record stands in its folder.
[[nodiscard]] std::vector<StoredFlight*> missing_of(const FlightStore& store,
                                                    const std::vector<StoredFlight*>& flights,
                                                    bool with_records);

/// `4 min 10 s left`, when so many of all have taken so long.
[[nodiscard]] std::string time_left(double elapsed_s, std::size_t done, std::size_t all);

}  // namespace flyball
