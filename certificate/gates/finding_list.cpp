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

constexpr std::size_t k_most_named = 20;

/// Results that have one thing in common, and where.
struct Places {
    std::vector<std::string> results;
    std::string argument;             ///< of their tables, "point"; "": none
    std::vector<std::string> points;  ///< of each of the results
};

/// The name of the argument of a row, "point", and what the row has there; two empty texts where the table has none.
std::pair<std::string, std::string> point_of(const FoundInRow& one) {
    const auto& argument = one.table->argument;
    return argument && one.row < argument->printed.size() ? std::pair(argument->name, argument->printed[one.row])
                                                          : std::pair<std::string, std::string>();
}

/// "E, point 3", "E, F, points 1, 2, 5", "E, angles 0, 30 and 12 more"; "E" of tables without points. Points that have a
/// comma in their names stand between semicolons.
std::string in_words(const Places& places) {
    std::string text = text::listed(places.results, k_most_named);
    const std::vector<std::string>& points = places.points;
    if (points.empty()) {
        return text;
    }
    text += ", " + places.argument + (points.size() > 1 ? "s " : " ");
    if (std::ranges::none_of(points, [](const std::string& p) { return p.find(", ") != std::string::npos; })) {
        return text + text::listed(points, k_most_named);
    }
    const std::size_t named = std::min(points.size(), k_most_named);
    for (std::size_t i = 0; i < named; ++i) {
        text += (i == 0 ? "" : "; ") + points[i];
    }
    return points.size() > named ? text + " and " + std::to_string(points.size() - named) + " more" : text;
}

/// Findings of one cause by result, a result that stands in several tables once; results with the same points together.
std::vector<Places> places_of(const std::vector<const FoundInRow*>& found) {
    std::vector<Places> of_results;
    for (const FoundInRow* one : found) {
        const auto [argument, point] = point_of(*one);
        auto known = std::ranges::find_if(of_results, [&argument = argument, one](const Places& p) {
            return p.argument == argument && p.results.front() == one->column->result;
        });
        if (known == of_results.end()) {
            known = of_results.insert(known, {.results = {one->column->result}, .argument = argument, .points = {}});
        }
        if (!argument.empty() && std::ranges::find(known->points, point) == known->points.end()) {
            known->points.push_back(point);
        }
    }
    std::vector<Places> places;
    for (Places& one : of_results) {
        const auto alike = std::ranges::find_if(
            places, [&](const Places& p) { return p.argument == one.argument && p.points == one.points; });
        if (alike == places.end()) {
            places.push_back(std::move(one));
        } else {
            alike->results.push_back(one.results.front());
        }
    }
    return places;
}

/// Where findings of one cause are. "E[1], F[3] and 2 more" where results have it at points of their own: as jobs name them.
std::string place_of(const std::vector<const FoundInRow*>& found) {
    const std::vector<Places> places = places_of(found);
    if (places.size() == 1) {
        return in_words(places.front());
    }
    std::vector<std::string> names;
    for (const Places& one : places) {
        for (const std::string& result : one.results) {
            if (one.points.empty()) {
                names.push_back(result);
            }
            for (const std::string& point : one.points) {
                names.push_back(result + "[" + point + "]");
            }
        }
    }
    return text::listed(names, k_most_named);
}

/// "; the numbers are those of point 3, the worst of 5": of several results with the name of its own.
std::string whose_numbers(const std::vector<const FoundInRow*>& found, const FoundInRow& worst) {
    const auto [argument, point] = point_of(worst);
    const bool of_one_result =
        std::ranges::all_of(found, [&](const FoundInRow* one) { return one->column->result == worst.column->result; });
    if (of_one_result && argument.empty()) {
        return {};
    }
    std::string text = "; the numbers are those of ";
    text += of_one_result ? "" : text::in_quotes(worst.column->result) + (argument.empty() ? "" : " at ");
    text += argument.empty() ? "" : argument + " " + point;
    const bool is_worst =
        std::ranges::any_of(found, [&](const FoundInRow* one) { return one->badness < worst.badness; });
    return is_worst ? text + ", the worst of " + std::to_string(found.size()) : text;
}

}  // namespace

void FindingList::add_by_cause(const std::vector<FoundInRow>& of_values, const CountedAs& counted) {
    struct Cause {
        std::string words;
        std::vector<const FoundInRow*> found;
    };
    std::vector<Cause> causes;
    for (const FoundInRow& one : of_values) {
        const Finding& f = one.finding;
        const std::string words = f.id + "\n" + std::to_string(static_cast<int>(f.severity)) + "\n" +
                                  without_numbers(f.what) + "\n" + f.action;
        const auto known = std::ranges::find(causes, words, &Cause::words);
        (known == causes.end() ? causes.emplace_back(Cause{.words = words, .found = {}}) : *known)
            .found.push_back(&one);
    }
    for (const Cause& cause : causes) {
        const FoundInRow& worst =
            **std::ranges::max_element(cause.found, {}, &FoundInRow::badness);  // the first of equals
        Finding finding = worst.finding;
        finding.where = place_of(cause.found);
        if (!counted.one.empty()) {
            const std::size_t count = cause.found.size();
            finding.what = std::to_string(count) + (count == 1 ? counted.one : counted.many) + finding.what;
        }
        if (std::ranges::any_of(cause.found,
                                [&](const auto* one) { return one->finding.what != worst.finding.what; })) {
            finding.what += whose_numbers(cause.found, worst);
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

bool is_authorised_by_no_signatory(const CertificateData& data) {
    const std::optional<Person>& person = data.persons.authorised_by;
    if (data.status != "accredited" || !data.accreditation || !person || !is_name(person->name)) {
        return false;
    }
    const std::vector<std::string>& all = data.accreditation->signatories;
    return !all.empty() &&
           std::ranges::none_of(all, [&](const std::string& name) { return is_same_name(name, person->name); });
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
