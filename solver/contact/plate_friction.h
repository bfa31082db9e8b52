#pragma once

#include <Eigen/Core>
#include <memory>
#include <utility>
#include <vector>

#include "solver/contact/plate_contact.h"
#include "solver/newton/following.h"
#include "solver/newton/model.h"

namespace mammotwin {

/// Coulomb friction with the plates, elastic up to a small slip, as an incremental potential per
/// reference area:
///
///     energy = Σ_plates μ t h(|s|),   s = (I − n nᵀ)(x − anchor)
///     h(s) = s²/δ − s³/(3δ²) for s <= δ,  s − δ/3 beyond
///
/// h is twice differentiable, and its slope, the share of μ t that acts, is 1 from δ on (Li et al.,
/// Incremental Potential Contact, ACM Trans. Graph. 39 (2020), section 5.1).
/// t, n: contact pressure and plate normal of a state (track), fixed while Newton makes a step, so
/// that the potential is convex and its hessian symmetric and semidefinite. Newton tracks before
/// each step, and takes in how t will move (circulation): friction has no potential of its own.
///
/// During a solve the share of μ t that acts, w = h' s/|s|, is an unknown of its own: w D(|s|) = s
/// with D = |s|/h' is linearised and not w = s/D, so that the hessian is
///
///     μ t/D (I − n nᵀ − D' (w sᵀ + s wᵀ)/(2|s|))
///
/// and w moves by the linear step, kept to |w| <= 1 (Chan, Golub, Mulet, SIAM J. Sci. Comput. 20
/// (1999), for total variation: where a point's slip turns, Newton on s alone overshoots its anchor
/// again and again). In the end w is the state's own, and the hessian the exact one.
///
/// anchor: the place on the plate where the point sticks, carried by the plate.
///
/// Approximations: a point that sticks creeps by up to δ (Wriggers, Computational Contact
/// Mechanics, section 5.2); slip is counted along the chord of a load step, from where the point
/// was at the end of the last one even if it came into contact later, so the path is followed to
/// first order in the step. Tilting of the plate moves its anchors with it.
class PlateFriction : public SurfacePotential {
 public:
  struct Contact {                                     ///< of one surface point with one plate
    Eigen::Vector3d anchor = Eigen::Vector3d::Zero();  ///< in the plate's frame [mm]
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    double pressure = 0;  ///< [kPa]
  };
  using History = std::vector<Contact>;  ///< all that a load step leaves to the next

  /// What holds one touching point, for solves near the state in which it touches.
  struct Hold {
    int point = 0, plate = 0;
    Eigen::Vector3d anchor = Eigen::Vector3d::Zero();  ///< in space [mm]
    double pressure = 0;                               ///< [kPa]
    double reach = 0;                                  ///< of frozen friction [mm]; 0: Coulomb's
  };

  /// Throws std::invalid_argument unless 0 < coefficient <= 1 and slip > 0. slip: δ [mm].
  PlateFriction(std::shared_ptr<const PlateContact> contact, double coefficient, double slip);

  /// Takes normals from a state, and pressures by a share of what they differ.
  void track(const Model& model, const State& state, const std::vector<std::pair<int, int>>& faces,
             double share = 1);

  /// Moves each point's w along with a step of the shape.
  void step(const Model& model, const State& from, const State& to,
            const std::vector<std::pair<int, int>>& faces);

  /// Ends a solve: each w is the state's own.
  void align() { shares_.clear(); }

  /// Ends a load step: anchors of sliding points follow to within δ, those of free points all the
  /// way. The first call, with the plates at their start, sets them.
  void commit(const Model& model, const State& state,
              const std::vector<std::pair<int, int>>& faces);

  /// What holds a state that was tracked. Anchors stand in space and not on the plates: plates that
  /// a problem puts elsewhere have not dragged the skin there.
  std::vector<Hold> holds(const Model& model, const State& state,
                          const std::vector<std::pair<int, int>>& faces) const;

  /// Begins at a state that was solved elsewhere and was held so. Other points are free.
  /// Throws std::invalid_argument if a hold is of no point or plate.
  void hold(const std::vector<Hold>& holds, const Model& model, const State& state,
            const std::vector<std::pair<int, int>>& faces);

  /// After `hold` at the same state: tractions stay as they are there, and points that move along
  /// their plate are drawn back as by springs that reach μ t at `reach` [mm] > 0. Pressures and
  /// normals are not followed any more, so that one potential holds for all states. What is held
  /// by frozen friction stays as it is.
  void freeze(double reach, const Model& model, const State& state,
              const std::vector<std::pair<int, int>>& faces);

  const History& history() const { return history_; }
  void restore(History history) { history_ = std::move(history); }

  /// Of a plate on a surface point at x [kPa].
  Eigen::Vector3d traction(const Eigen::Vector3d& x, const SurfacePoint& point, int plate) const;

  Slots slots() const override { return kPosition; }
  bool respond(const Eigen::Matrix<double, 9, 1>& y, const SurfacePoint& point, int order,
               SurfaceResponse& response) const override;

  /// By ∂t/∂x; the normals' change is left out: plates are flat but for their edges.
  bool circulation(const Eigen::Matrix<double, 9, 1>& y, const SurfacePoint& point,
                   Eigen::Matrix3d& derivative) const override;

 private:
  struct SlipEnergy {
    double energy, slope_over_slip;  ///< h and h'/s
  };
  const Contact& at(const SurfacePoint& point, int plate) const;
  SlipEnergy energy(double slip) const;
  double ratio_slope(double slip) const;
  Eigen::Vector3d moved_share(const Eigen::Vector3d& share, const Eigen::Vector3d& from,
                              const Eigen::Vector3d& to) const;
  Eigen::Vector3d slip(const Eigen::Vector3d& x, const Contact& contact, const Plate& plate) const;

  std::shared_ptr<const PlateContact> contact_;
  double coefficient_, slip_;
  double reach_ = 0;                     ///< of frozen friction's springs [mm]; 0: not frozen
  History history_;                      ///< by surface point, then plate
  std::vector<Eigen::Vector3d> shares_;  ///< w, alike; empty: each is its state's own
};

/// What Newton calls to follow friction on these faces. All must outlive it.
Following following(PlateFriction& friction, const Model& model,
                    const std::vector<std::pair<int, int>>& faces);

}  // namespace mammotwin
