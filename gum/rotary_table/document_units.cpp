#include "gum/rotary_table/document_units.h"

namespace gumcert::gum {

const DocumentUnit& unit_of(const std::string& record_name) {
    return record_name == k_um.record ? k_um : k_arcsec;
}

const DocumentUnit& unit_of(const OutputQuantity& quantity) {
    return quantity.unit == "m" ? k_um : k_arcsec;
}

}  // namespace gumcert::gum
