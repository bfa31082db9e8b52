#include "registration/search/what_if.h"

namespace mammotwin {

ViewState what_if_ranges() {
  ViewState range = ViewState::Zero();
  for (const WhatIf& varied : kWhatIf) range[varied.number] = varied.range;
  return range;
}

WhatIfShapes what_if_shapes(const ReducedView& reduced, const ViewState& z,
                            const ViewFrame& frame) {
  WhatIfShapes shapes;
  for (std::size_t n = 0; n < kWhatIf.size(); ++n) {
    const auto& [number, range] = kWhatIf[n];
    if (reduced.modes[number].linear.empty()) continue;
    const ViewState by = range / reduced.sd[number] * ViewState::Unit(number);
    shapes[n] = {in_lps(reduced.nodes_at(z + by), frame), in_lps(reduced.nodes_at(z - by), frame)};
  }
  return shapes;
}

ReducedView what_if_view(const WhatIfShapes& shapes, const HermiteMesh& compressed,
                         const ViewFrame& frame) {
  ReducedView view;
  view.elements = compressed.elements();
  view.base = in_view(compressed.nodes(), frame);
  view.sd = what_if_ranges();
  for (std::size_t n = 0; n < kWhatIf.size(); ++n) {
    if (shapes[n].up.empty()) continue;
    const Nodes up = in_view(shapes[n].up, frame), down = in_view(shapes[n].down, frame);
    view.modes[kWhatIf[n].number] = {combined(0.5, up, -0.5, down),
                                     combined(1, combined(0.5, up, 0.5, down), -1, view.base)};
  }
  return view;
}

}  // namespace mammotwin
