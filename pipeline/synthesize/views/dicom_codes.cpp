#include "pipeline/synthesize/views/dicom_codes.h"

namespace mammotwin {

DcmItem& put_code(DcmItem& object, const DcmTagKey& sequence, const char* value,
                  const char* meaning) {
  DcmItem& item = dicom::new_item(object, sequence);
  dicom::put(item, DCM_CodeValue, value);
  dicom::put(item, DCM_CodingSchemeDesignator, "SCT");
  dicom::put(item, DCM_CodeMeaning, meaning);
  return item;
}

void put_view_code(DcmItem& object, const std::string& view) {
  DcmItem& code =
      view == "cc" ? put_code(object, DCM_ViewCodeSequence, "399162004", "cranio-caudal")
                   : put_code(object, DCM_ViewCodeSequence, "399368009", "medio-lateral oblique");
  code.insertEmptyElement(DCM_ViewModifierCodeSequence);
}

}  // namespace mammotwin
