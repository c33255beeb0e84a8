#include "reports/record/record_sections.h"

#include <algorithm>
#include <cstddef>

namespace gumcert::reports {

const SectionSummary* section_of(const EvaluationRecord& record, const std::string& quantity) {
    const auto found = std::find_if(record.sections.begin(), record.sections.end(), [&](const SectionSummary& s) {
        return std::find(s.quantities.begin(), s.quantities.end(), quantity) != s.quantities.end();
    });
    return found == record.sections.end() ? nullptr : &*found;
}

certificate::LocalisedText title_of(const SectionSummary& section) {
    return section.title.empty() ? certificate::LocalisedText(section.name) : section.title;
}

certificate::LocalisedText title_of(const EvaluationRecord& record) {
    return record.title_by_language.empty() ? certificate::LocalisedText(record.title) : record.title_by_language;
}

std::vector<std::string> equations_of(const EvaluationRecord& record, const std::string& quantity) {
    if (!record.model) {
        return {};
    }
    const std::vector<std::string>& all = record.model->equations;
    const SectionSummary* const section = section_of(record, quantity);
    if (section == nullptr) {
        return all;
    }
    std::ptrdiff_t first = 0;
    for (const SectionSummary& before : record.sections) {
        if (&before == section) {
            break;
        }
        first += before.equations;
    }
    return {all.begin() + first, all.begin() + first + section->equations};
}

}  // namespace gumcert::reports
