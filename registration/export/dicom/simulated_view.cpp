#include <cctype>

#include "registration/export/burned_words.h"
#include "registration/export/dicom/dicom_export.h"
#include "registration/export/dicom/dicom_object.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using namespace dicom;

std::string upper(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

}  // namespace

void write_simulated_view(const fs::path& path, const fs::path& mammogram, const GreyPixels& bare,
                          double spacing_mm, const std::string& orientation,
                          const std::string& key) {
  const GreyPixels pixels = with_words(bare, "SIMULATED");
  DcmFileFormat source_file = load(mammogram), file;
  DcmItem &source = *source_file.getDataset(), &object = *file.getDataset();
  begin(source, UID_SecondaryCaptureImageStorage, "OT", key, moment_of_making(), object);
  put(object, DCM_SeriesDescription, "SIMULATED " + upper(key) + " from MRI, no exposure");
  put(object, DCM_BodyPartExamined, "BREAST");
  put(object, DCM_Laterality, text_of(source, DCM_ImageLaterality));
  put(object, DCM_ConversionType, "WSD");
  put(object, DCM_PatientOrientation, orientation);
  put(object, DCM_ImageType, "DERIVED\\SECONDARY");
  put(object, DCM_DerivationDescription, "Simulated from the compressed model of the breast's MRI");
  put(object, DCM_ImageComments, "Simulated, not an X-ray exposure");
  put(object, DCM_BurnedInAnnotation, "YES");
  const std::string spacing = number(spacing_mm) + "\\" + number(spacing_mm);
  put(object, DCM_PixelSpacing, spacing);
  object.putAndInsertUint16(DCM_Rows, static_cast<Uint16>(pixels.rows));
  object.putAndInsertUint16(DCM_Columns, static_cast<Uint16>(pixels.columns));
  object.putAndInsertUint16(DCM_SamplesPerPixel, 1);
  put(object, DCM_PhotometricInterpretation, "MONOCHROME2");
  object.putAndInsertUint16(DCM_BitsAllocated, 16);
  object.putAndInsertUint16(DCM_BitsStored, 16);
  object.putAndInsertUint16(DCM_HighBit, 15);
  object.putAndInsertUint16(DCM_PixelRepresentation, 0);
  object.putAndInsertUint16Array(DCM_PixelData, pixels.grey.data(), pixels.grey.size());
  save(file, path);
}

}  // namespace mammotwin
