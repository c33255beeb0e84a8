#include "certificate/gates/finding_list.h"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>

#include "certificate/result_names.h"
#include "certificate/stated_text.h"
#include "text/visible_text.h"

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
        return o.clause == clause && may_be_left_out(clause) && is_statement(o.reason);
    });
    if (omission == data_.omissions.end()) {
        add(severity, id, iso_17025(clause), where, what, action);
        return;
    }
    const FindingSeverity left = severity_of_omission(clause);
    add(left, id, iso_17025(clause), where, what + "; left out for the reason: " + omission->reason.in("en"),
        left == FindingSeverity::information ? "" : "State it, unless the reason is one that an assessor accepts.");
}

void FindingList::append(std::vector<Finding> findings) {
    findings_.insert(findings_.end(), std::make_move_iterator(findings.begin()),
                     std::make_move_iterator(findings.end()));
}

bool FindingList::add_gravest(const std::vector<Finding>& of_points) {
    // One slip in an entry of the scope shows at every point of a table. Told once, it does not hide the other
    // findings.
    const auto gravest = std::ranges::max_element(of_points, {}, &Finding::severity);
    if (gravest == of_points.end()) {
        return false;
    }
    findings_.push_back(*gravest);
    return true;
}

bool may_be_left_out(const std::string& clause) {
    constexpr std::string_view k_list = "7.8.2.1 ";
    return clause.size() == k_list.size() + 1 && clause.starts_with(k_list) &&
           std::string_view("cehknp").find(clause.back()) != std::string_view::npos;
}

FindingSeverity severity_of_omission(const std::string& clause) {
    switch (clause.empty() ? ' ' : clause.back()) {
        case 'e':
        case 'p':
            return FindingSeverity::major;
        case 'c':
        case 'n':
            return FindingSeverity::minor;
        default:
            return FindingSeverity::information;
    }
}

const std::string& last_day(const Dates& dates) {
    return dates.performed_to.empty() ? dates.performed_from : dates.performed_to;
}

bool names_a_result(const Certificate& certificate, const std::vector<std::string>& names) {
    return std::any_of(certificate.tables.begin(), certificate.tables.end(), [&](const CertifiedTable& table) {
        return std::any_of(table.columns.begin(), table.columns.end(), [&](const CertifiedColumn& column) {
            if (is_named(names, column.result)) {
                return true;
            }
            const bool has_points = table.argument && table.argument->name == "point";
            return has_points &&
                   std::any_of(table.argument->printed.begin(), table.argument->printed.end(),
                               [&](const auto& point) { return is_named(names, column.result + "[" + point + "]"); });
        });
    });
}

std::vector<std::string> names_of_no_result(const Certificate& certificate, const std::vector<std::string>& names) {
    std::vector<std::string> none;
    std::copy_if(names.begin(), names.end(), std::back_inserter(none),
                 [&](const std::string& name) { return !names_a_result(certificate, {name}); });
    return none;
}

std::vector<std::string> result_names(const Certificate& certificate, const std::vector<std::string>& meant) {
    std::vector<std::string> names;
    const auto add = [&](const std::string& name) {
        std::string quoted = text::in_quotes(name);
        if (std::find(names.begin(), names.end(), quoted) == names.end()) {
            names.push_back(std::move(quoted));
        }
    };
    for (const CertifiedTable& table : certificate.tables) {
        for (const CertifiedColumn& column : table.columns) {
            const bool is_point = std::any_of(meant.begin(), meant.end(), [&](const std::string& name) {
                return name.starts_with(column.result + "[") && table.argument && table.argument->name == "point";
            });
            if (!is_point) {
                add(column.result);
                continue;
            }
            for (const std::string& point : table.argument->printed) {
                add(column.result + "[" + point + "]");
            }
        }
    }
    return names;
}

std::string iso_17025(const std::string& clause) {
    return "ISO/IEC 17025:2017, " + clause;
}

std::string place_in(const std::string& list, std::size_t index, const std::string& key) {
    return list + "/" + std::to_string(index) + (key.empty() ? "" : "/" + key);
}

std::string what_of_name(const std::string& given, const std::string& missing) {
    return given.empty() ? missing : text::in_quotes(given) + " is taken for a placeholder, not for a name";
}

std::string action_of_name(const std::string& given, const std::string& action) {
    return given.empty() ? action : "Write the name in full; docs/findings.md has what does not count as stated.";
}

}  // namespace gumcert::certificate
