#include "certificate/gates/finding_list.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string_view>
#include <utility>

#include "certificate/result_names.h"
#include "certificate/stated_text.h"
#include "text/lists.h"
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

namespace {

/// A sentence without its numbers: 1.2, -0.0 and 3.1E-5, but not those of names such as DR-03, and none within quotes.
std::string without_numbers(const std::string& sentence) {
    constexpr char k_quote = 0x22;
    const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
    std::string out;
    bool quoted = false;
    for (std::size_t i = 0; i < sentence.size(); ++i) {
        quoted = quoted != (sentence[i] == k_quote);
        const bool after_sign = !out.empty() && out.back() == '-';
        const std::size_t before = out.size() - (after_sign ? 1 : 0);
        const bool begins = before == 0 || std::string_view(" (<>").find(out[before - 1]) != std::string_view::npos;
        if (quoted || !is_digit(sentence[i]) || !begins) {
            out += sentence[i];
            continue;
        }
        out.resize(before);
        out += '#';
        i = std::min(sentence.find_first_not_of("0123456789.,E+-", i), sentence.size()) - 1;
    }
    return out;
}

/// "E, point 3", "E, points 1, 2, 5", "E, angles 0, 30 and 12 more"; "E" of a table without points. Points that have a
/// comma in their names stand between semicolons.
std::string place_of_rows(const CertifiedTable& table, const CertifiedColumn& column,
                          const std::vector<std::size_t>& rows) {
    constexpr std::size_t k_most_named = 20;
    std::vector<std::string> points;
    for (const std::size_t row : rows) {
        if (table.argument && row < table.argument->printed.size()) {
            points.push_back(table.argument->printed[row]);
        }
    }
    if (points.empty()) {
        return column.result;
    }
    std::string text = column.result + ", " + table.argument->name + (points.size() > 1 ? "s " : " ");
    if (std::ranges::none_of(points, [](const std::string& p) { return p.find(", ") != std::string::npos; })) {
        return text + text::listed(points, k_most_named);
    }
    const std::size_t named = std::min(points.size(), k_most_named);
    for (std::size_t i = 0; i < named; ++i) {
        text += (i == 0 ? "" : "; ") + points[i];
    }
    return points.size() > named ? text + " and " + std::to_string(points.size() - named) + " more" : text;
}

}  // namespace

void FindingList::add_by_cause(const CertifiedTable& table, const CertifiedColumn& column,
                               const std::vector<FoundInRow>& of_rows) {
    struct Cause {
        std::string words;
        std::vector<const FoundInRow*> found;
    };
    std::vector<Cause> causes;
    for (const FoundInRow& one : of_rows) {
        const Finding& f = one.finding;
        const std::string words = f.id + "\n" + std::to_string(static_cast<int>(f.severity)) + "\n" +
                                  without_numbers(f.what) + "\n" + f.action;
        const auto known = std::ranges::find(causes, words, &Cause::words);
        (known == causes.end() ? causes.emplace_back(Cause{.words = words, .found = {}}) : *known)
            .found.push_back(&one);
    }
    for (const Cause& cause : causes) {
        const FoundInRow& first = *cause.found.front();
        std::vector<std::size_t> rows;
        std::ranges::transform(cause.found, std::back_inserter(rows), &FoundInRow::row);
        Finding finding = first.finding;
        finding.where = place_of_rows(table, column, rows);
        const bool has_point = table.argument && first.row < table.argument->printed.size();
        if (has_point &&
            std::ranges::any_of(cause.found, [&](const auto* one) { return one->finding.what != finding.what; })) {
            finding.what +=
                "; the numbers are those of " + table.argument->name + " " + table.argument->printed[first.row];
        }
        findings_.push_back(std::move(finding));
    }
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
bool is_authorised_by_no_signatory(const CertificateData& data) {
    const std::optional<Person>& person = data.persons.authorised_by;
    if (data.status != "accredited" || !data.accreditation || !person || !is_name(person->name)) {
        return false;
    }
    const std::vector<std::string>& all = data.accreditation->signatories;
    return !all.empty() &&
           std::ranges::none_of(all, [&](const std::string& name) { return is_same_name(name, person->name); });
}

