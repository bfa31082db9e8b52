#pragma once

#include <nlohmann/json_fwd.hpp>

#include "pipeline/frame/products.h"
#include "pipeline/steps/lesion_ellipses.h"
#include "registration/export/lesion_table.h"
#include "registration/prediction/simulated_mammogram.h"

namespace mammotwin {

/// One view, ready to be written.
struct PredictedView {
  const RegisteredView& registered;
  ProjectedFindings findings;
  std::vector<LesionEllipse> ellipses;  ///< one a lesion, or none
};

/// A lesion has one row for the prone MRI and one for each view, view by view.
std::vector<LesionRow> lesion_rows(const std::string& patient, Side side, const Findings& findings,
                                   const std::vector<PredictedView>& views);

/// Where each lesion is with the patient on her back, in its row of the MRI: where `unload` found
/// that state.
void add_supine(const Findings& findings, const RegisteredView& view, std::vector<LesionRow>& rows);

/// lesions_prone.mrk.json, and lesions_<state>.mrk.json for the breast in each other state that the
/// view's file holds ("unloaded", "standing", "supine"), for biopsy and radiotherapy.
void write_states(const Findings& findings, const RegisteredView& view, Products& products);

/// For a view "cc": ellipse_cc_1.mrk.json ..., lesions_cc.mrk.json and cc_registered.vtu.
void write_prediction(const PredictedView& view, Products& products);

/// cc_from_prone.nrrd and prone_from_cc.nrrd, simulated_cc.png and, with an MRI, mri_in_cc.nrrd;
/// the fields' composition error goes to `quality`. Returns the view as shown.
DetectorImage write_view_files(const RegisteredView& view, const Segmentation& segmentation,
                               const std::optional<Volume<float>>& mri, Products& products,
                               nlohmann::json& quality);

}  // namespace mammotwin
