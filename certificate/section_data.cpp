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

namespace {

bool states_nothing(const Method& method) {
    return method.identification.empty() && method.version.empty() && method.title.empty() &&
           method.description.empty() && method.standard.empty() && method.deviations.empty();
}

}  // namespace

bool is_same_item(const Item& a, const Item& b) {
    return a.description == b.description && a.manufacturer == b.manufacturer && a.type == b.type &&
           a.serial_number == b.serial_number && a.identification == b.identification;
}

StatedBySections stated_by_sections(const CertificateData& data, const std::vector<CertifiedTable>& tables) {
    const auto each_states = [&](const auto& states) {
        return !tables.empty() && std::all_of(tables.begin(), tables.end(), [&](const CertifiedTable& table) {
            return std::any_of(data.sections.begin(), data.sections.end(), [&](const SectionData& section) {
                return section.section == table.section && states(section);
            });
        });
    };
    return {.item = data.item.serial_number.empty() && data.item.identification.empty() &&
                    each_states([](const SectionData& section) { return section.item.has_value(); }),
            .method = states_nothing(data.method) &&
                      each_states([](const SectionData& section) { return section.method.has_value(); }),
            .conditions = data.conditions.empty() &&
                          each_states([](const SectionData& section) { return !section.conditions.empty(); })};
}

std::vector<const Item*> items_of(const CertificateData& data) {
    std::vector<const Item*> items;
    const auto says_nothing = [](const Item& item) {
        return item.description.empty() && item.serial_number.empty() && item.identification.empty();
    };
    if (!says_nothing(data.item)) {
        items.push_back(&data.item);
    }
    for (const SectionData& section : data.sections) {
        // Several sections may be of one item.
        if (section.item && std::none_of(items.begin(), items.end(),
                                         [&](const Item* known) { return is_same_item(*known, *section.item); })) {
            items.push_back(&*section.item);
        }
    }
    return items;
}

bool has_several_items(const CertificateData& data) {
    return items_of(data).size() > 1;
}

}  // namespace gumcert::certificate
