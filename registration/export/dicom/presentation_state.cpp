#include "registration/export/dicom/dicom_object.h"
#include "registration/export/dicom/image_points.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using namespace dicom;

void refer(DcmItem& source, DcmItem& object) {
  DcmItem& series = new_item(object, DCM_ReferencedSeriesSequence);
  put(series, DCM_SeriesInstanceUID, text_of(source, DCM_SeriesInstanceUID));
  DcmItem& image = new_item(series, DCM_ReferencedImageSequence);
  put(image, DCM_ReferencedSOPClassUID, text_of(source, DCM_SOPClassUID));
  put(image, DCM_ReferencedSOPInstanceUID, text_of(source, DCM_SOPInstanceUID));
}

void annotate(const Detector& detector, const AnnotatedMark& mark, DcmItem& annotation) {
  DcmItem& graphic = new_item(annotation, DCM_GraphicObjectSequence);
  put(graphic, DCM_GraphicAnnotationUnits, "PIXEL");
  graphic.putAndInsertUint16(DCM_GraphicDimensions, 2);
  graphic.putAndInsertUint16(DCM_NumberOfGraphicPoints, 4);
  const std::vector<Float32> ends = on_image(detector, ends_of(mark));
  graphic.putAndInsertFloat32Array(DCM_GraphicData, ends.data(), ends.size());
  put(graphic, DCM_GraphicType, "ELLIPSE");
  put(graphic, DCM_GraphicFilled, "N");
  DcmItem& text = new_item(annotation, DCM_TextObjectSequence);
  put(text, DCM_AnchorPointAnnotationUnits, "PIXEL");
  put(text, DCM_UnformattedTextValue, in_ascii(mark.id) + " (MRI), 90 %");
  const std::vector<Float32> anchor = on_image(detector, {mark.on_detector});
  text.putAndInsertFloat32Array(DCM_AnchorPoint, anchor.data(), anchor.size());
  put(text, DCM_AnchorPointVisibility, "N");
}

void refer_to_slice(DcmItem& source, int slice, DcmItem& annotation) {
  DcmItem& image = new_item(annotation, DCM_ReferencedImageSequence);
  put(image, DCM_ReferencedSOPClassUID, text_of(source, DCM_SOPClassUID));
  put(image, DCM_ReferencedSOPInstanceUID, text_of(source, DCM_SOPInstanceUID));
  put(image, DCM_ReferencedFrameNumber, std::to_string(slice));
}

void show_whole(const PixelGrid& grid, DcmItem& object) {
  DcmItem& area = new_item(object, DCM_DisplayedAreaSelectionSequence);
  put(area, DCM_DisplayedAreaTopLeftHandCorner, "1\\1");
  put(area, DCM_DisplayedAreaBottomRightHandCorner,
      std::to_string(grid.columns) + "\\" + std::to_string(grid.rows));
  put(area, DCM_PresentationSizeMode, "SCALE TO FIT");
  put(area, DCM_PresentationPixelAspectRatio, "1\\1");
}

}  // namespace

void write_presentation_state(const fs::path& path, const fs::path& mammogram,
                              const Detector& detector, const std::vector<AnnotatedMark>& marks,
                              const std::string& key) {
  DcmFileFormat source_file = load(mammogram), file;
  DcmItem &source = *source_file.getDataset(), &object = *file.getDataset();
  const Moment made = moment_of_making();
  begin(source, UID_GrayscaleSoftcopyPresentationStateStorage, "PR", key, made, object);
  put(object, DCM_SeriesDescription, "Predicted places of MRI lesions, " + key);
  put(object, DCM_Laterality, text_of(source, DCM_ImageLaterality));
  put(object, DCM_ContentLabel, "MAMMOTWIN");
  put(object, DCM_ContentDescription, "Predicted places of lesions seen in MRI");
  put(object, DCM_PresentationCreationDate, made.date);
  put(object, DCM_PresentationCreationTime, made.time);
  put(object, DCM_ContentCreatorName, kMaker);
  refer(source, object);
  show_whole(*detector.pixels, object);
  for (const AnnotatedMark& mark : marks) {
    DcmItem& annotation = new_item(object, DCM_GraphicAnnotationSequence);
    put(annotation, DCM_GraphicLayer, "LESIONS");
    if (mark.slice) refer_to_slice(source, *mark.slice, annotation);
    annotate(detector, mark, annotation);
  }
  DcmItem& layer = new_item(object, DCM_GraphicLayerSequence);
  put(layer, DCM_GraphicLayer, "LESIONS");
  put(layer, DCM_GraphicLayerOrder, "1");
  put(object, DCM_PresentationLUTShape, "IDENTITY");
  save(file, path);
}

}  // namespace mammotwin
