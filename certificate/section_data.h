#pragma once

#include <string_view>
#include <vector>

#include "certificate/certified_results.h"

namespace gumcert::certificate {

/// The data as they hold for the results of one section of a job: item, method, standards and conditions that the section
/// states stand in place of those of the whole certificate. All else is the same.
/// \param section  its name; one that states nothing of its own, or "", has the data of the certificate
[[nodiscard]] CertificateData data_of_section(const CertificateData& data, std::string_view section);

/// What each section that has results states of its own, where the certificate as a whole does not state it: a set of
/// instruments has an item a section and none of the whole.
struct StatedBySections {
    bool item = false;  ///< description and condition may stand for all
    bool method = false, conditions = false;
};
/// \param tables  of the certificate: they say which sections there are
[[nodiscard]] StatedBySections stated_by_sections(const CertificateData& data,
                                                  const std::vector<CertifiedTable>& tables);

/// What the results are of: the item of the certificate, where it states one, then those of the sections, each
/// once.
[[nodiscard]] std::vector<const Item*> items_of(const CertificateData& data);
/// Whether two sections are about one item: description, manufacturer, type and numbers are the same.
[[nodiscard]] bool is_same_item(const Item& a, const Item& b);
/// Whether sentences speak of the items, and not of the item.
[[nodiscard]] bool has_several_items(const CertificateData& data);

}  // namespace gumcert::certificate
