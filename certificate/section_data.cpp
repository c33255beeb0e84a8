#include "certificate/section_data.h"

#include <algorithm>

namespace gumcert::certificate {

CertificateData data_of_section(const CertificateData& data, std::string_view section) {
    CertificateData own = data;
    const auto stated = std::find_if(data.sections.begin(), data.sections.end(),
                                     [&](const SectionData& one) { return one.section == section; });
    if (stated == data.sections.end()) {
        return own;
    }
    own.item = stated->item.value_or(data.item);
    own.method = stated->method.value_or(data.method);
    if (!stated->conditions.empty()) {
        own.conditions = stated->conditions;
    }
    if (!stated->standards.empty()) {
        std::erase_if(own.standards, [&](const StandardUsed& s) {
            return std::find(stated->standards.begin(), stated->standards.end(), s.identification) ==
                   stated->standards.end();
        });
    }
    return own;
}

}  // namespace gumcert::certificate
