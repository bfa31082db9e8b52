#pragma once

#include "solver/press/compression_result.h"
#include "solver/press/press.h"

namespace mammotwin {

/// Fills in what can be measured on a state: thickness, force, area, J, penetration, tissue kept.
void measure_compression(const Press& press, const State& state, CompressionReport& report);

/// Of the tissue in front of the plates' edges when the plates came, how much is there still.
double retained_fraction(const Press& press, const State& state);

/// Whether most of the tissue in front of the plates' edges went behind them. Breasts that stay
/// keep two thirds of it or more, those that slip out under a quarter.
bool slipped_out(const Press& press, const State& state);

/// The paddle's force as the central difference of the total potential over its height, friction's
/// part with it (contact pressures as they are: its potential knows no other) [N]. NaN where a
/// neighbour finds no equilibrium. The plates end where they were.
double force_from_energy(Press& press, const State& state);

}  // namespace mammotwin
