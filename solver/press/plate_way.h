#pragma once

#include <string>

#include "solver/contact/plate_placement.h"
#include "solver/press/compression_problem.h"

namespace mammotwin {

/// The plates' way from where they just touch the breast to where they press it to its thickness.
class PlateWay {
 public:
  /// Throws std::invalid_argument if the thickness is not between 0 and the breast's own, or if the
  /// plates would never touch it. All must outlive this.
  PlateWay(const PlateFrame& frame, const CompressionProblem& problem, Moving moving);

  PlacedPlates start() const { return at(0, tilt_); }

  /// fraction: of the way, in [0, 1]. tilt: of the paddle [deg].
  PlacedPlates at(double fraction, double tilt) const;

  /// The way ends where it is at this fraction now; fractions are counted anew.
  void end_at(double fraction);

  /// Where the plates are so far apart [mm].
  double fraction_at(double apart) const;

  /// Of the plates, the longer one of two that move together [mm].
  double longest() const;

 private:
  struct Heights {
    double support, paddle;
  };
  Heights at(double fraction) const;

  const PlateFrame& frame_;
  Moving moving_;
  double tilt_;  ///< of the paddle without load [deg]
  Heights start_, end_;
};

/// "56.02 mm".
std::string in_mm(double length);

}  // namespace mammotwin
