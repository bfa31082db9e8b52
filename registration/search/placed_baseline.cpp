#include "registration/search/placed_baseline.h"

#include "registration/search/pose_search.h"

namespace mammotwin {
namespace {

/// The prone breast mapped by the baseline, as a view that can only be turned and shifted.
ReducedView rigid_view(const HermiteMesh& prone, const AffineBaseline& baseline,
                       const EdgePrior& edge) {
  ReducedView view;
  view.expect(edge);
  view.elements = prone.elements();
  view.base = prone.nodes();
  const Eigen::Vector3d zero = baseline.view_from_prone(Eigen::Vector3d::Zero());
  for (HermiteMesh::Node& node : view.base)
    for (int d = 0; d < 8; ++d) {
      const Eigen::Vector3d mapped = baseline.view_from_prone(node.col(d));
      node.col(d) = d == 0 ? mapped : mapped - zero;  // derivatives know no origin
    }
  return view;
}

}  // namespace

HermiteMesh prone_of(const MeshFile& compressed) {
  return HermiteMesh(compressed.configurations.at("prone"), compressed.mesh.elements());
}

PlacedBaseline placed_baseline(const MeshFile& compressed, const CompressedView& view,
                               const Eigen::Vector3d& nipple_in_lps, const EdgePrior& edge,
                               const Detector& detector,
                               const std::optional<ViewEvidence>& evidence) {
  const HermiteMesh prone = prone_of(compressed);
  AffineBaseline baseline(prone, view);
  if (!evidence) {
    baseline.place(edge.mean[kTurn], edge.mean.segment<2>(kShiftDepth));
    return {baseline, {}};
  }
  const ViewMatch match(rigid_view(prone, baseline, edge), compressed.faces, prone, nullptr,
                        nipple_in_lps, detector, *evidence);
  const ViewState z = search_pose({&match}, {match.view().mean()}, true).states.front();
  const ViewState state = z.cwiseProduct(match.view().sd);
  baseline.place(state[kTurn], {state[kShiftDepth], state[kShiftLateral]});
  return {baseline, match.figures(z)};
}

}  // namespace mammotwin
