#include "certificate/finding_list.h"

#include <algorithm>
#include <string_view>

#include "certificate/stated_text.h"

namespace gumcert::certificate {

void FindingList::add(FindingSeverity severity, const std::string& id, const std::string& clause,
                      const std::string& where, const std::string& what, const std::string& action) {
    findings_.push_back(
        {.id = id, .clause = clause, .severity = severity, .where = where, .what = what, .action = action});
}

void FindingList::item(FindingSeverity severity, char letter, const std::string& where, const std::string& what,
                       const std::string& action) {
    const std::string clause = std::string("7.8.2.1 ") + letter;
    const std::string id = std::string("R07-") + letter;
    const auto omission = std::find_if(data_.omissions.begin(), data_.omissions.end(), [&](const Omission& o) {
        return o.clause == clause && may_be_left_out(clause) && is_stated(o.reason);
    });
    if (omission == data_.omissions.end()) {
        add(severity, id, iso_17025(clause), where, what, action);
        return;
    }
    add(FindingSeverity::information, id, iso_17025(clause), where,
        what + "; left out for the reason: " + omission->reason.in("en"), "");
}

bool may_be_left_out(const std::string& clause) {
    constexpr std::string_view k_list = "7.8.2.1 ";
    return clause.size() == k_list.size() + 1 && clause.starts_with(k_list) &&
           std::string_view("cefghknp").find(clause.back()) != std::string_view::npos;
}

std::string iso_17025(const std::string& clause) {
    return "ISO/IEC 17025:2017, " + clause;
}

std::string place_in(const std::string& list, std::size_t index, const std::string& key) {
    return list + "/" + std::to_string(index) + (key.empty() ? "" : "/" + key);
}

}  // namespace gumcert::certificate
