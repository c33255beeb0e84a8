#pragma once

#include <string>
#include <vector>

#include "reports/dcc/dcc_writer.h"

namespace gumcert::reports {

/// One number without uncertainty.
struct PlainQuantity {
    std::string element;  ///< "dcc:quantity", "dcc:measuringEquipmentQuantity" …
    Text name;
    std::string ref_type;
    std::string value;       ///< as D-SI writes numbers
    std::string unit;        ///< UDUNITS-2
    std::string label = {};  ///< result that the number belongs to; "" for none
};
void write_plain_quantity(DccWriter& writer, const PlainQuantity& quantity);

/// Numbers of one column, without uncertainty.
struct PlainList {
    Text name;
    std::string ref_type;
    std::vector<std::string> values;  ///< as D-SI writes numbers
    std::string unit;                 ///< UDUNITS-2
    std::string label = {};           ///< result that the numbers belong to; "" for none
    std::string stage = {};           ///< as write_stage() takes it
};
void write_plain_list(DccWriter& writer, const PlainList& list);

/// That the numbers of a quantity were found before ("as_found") or after an adjustment ("as_left"); "": nothing.
void write_stage(DccWriter& writer, const std::string& stage);

/// Entries joined by one blank; one entry where all are the same.
[[nodiscard]] std::string joined_list(const std::vector<std::string>& entries);
/// The same, with every entry.
[[nodiscard]] std::string full_list(const std::vector<std::string>& entries);

/// Meta data that define a unit which D-SI does not have; nothing for one that it has.
void write_unit_definition(DccWriter& writer, const std::string& udunits);
[[nodiscard]] bool needs_unit_definition(const std::string& udunits);

/// Unit of an uncertainty: "degC" → "K".
[[nodiscard]] std::string unit_of_uncertainty(const std::string& udunits);

/// "0.2.0-3-gabc" → "v0.2.0": a letter and up to four groups of digits, as the business rules want it.
[[nodiscard]] std::string dcc_release(const std::string& version);

}  // namespace gumcert::reports
