#pragma once

#include <map>
#include <string>

#include "fitting/mesh/mesh_file.h"
#include "solver/press/press.h"

namespace mammotwin {

/// What a state does to the tissue, to look at, on the reference mesh's control points:
///
/// | field | |
/// |---|---|
/// | principal_stretches | λ₁ ≥ λ₂ ≥ λ₃ [-] |
/// | green_strain, second_piola_kirchhoff_kPa | E, S: xx, yy, zz, xy, yz, xz in the mesh's axes |
/// | von_mises_kPa, mean_pressure_kPa | of Cauchy's stress σ; −tr σ/3 |
/// | contact_gap_mm | to the nearer plate, negative inside |
/// | contact_pressure_kPa | of both plates per reference area; 0 off the skin and cut faces |
///
/// Each value is a mean of the quadrature points' about its control point, weighted by volume (on
/// the plates by area) and the point's Bernstein polynomial: never beyond theirs, continuous,
/// smoothed over about a third of an element. Figures are for the report's numbers instead.
std::map<std::string, PointField> solution_fields(const Press& press, const State& state);

}  // namespace mammotwin
