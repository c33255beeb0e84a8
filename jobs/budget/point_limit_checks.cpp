#include "jobs/budget/point_limit_checks.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <set>
#include <string_view>

#include <nlohmann/json.hpp>

#include "certificate/point_limits.h"
#include "certificate/result_names.h"
#include "jobs/budget/budget_job_statement.h"
#include "jobs/input_codes.h"
#include "text/lists.h"
#include "text/numbers.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

namespace {

using certificate::PointColumn;
using nlohmann::json;

constexpr const char* k_take_nominal_values =
    "name a column of nominal values, with the role \"nominal\", in \"of\" of the argument";

class PointLimitChecks {
public:
    PointLimitChecks(const JsonDocument& document, const BudgetJob& job, const ResultsOfSections& results,
                     ProblemList& problems)
        : document_(document), job_(job), results_(results), problems_(problems) {}

    void check() {
        if (!job_.certificate) {
            return;
        }
        const certificate::PointTable points = table_of_points();
        warn_of_unused_limits();
        for (const certificate::AgreedSpecification& s : job_.certificate->specifications) {
            if (!s.limits) {
                continue;
            }
            const std::string where = document_.where("/certificate");
            const std::string name = "the specification " + text::in_quotes(s.id);
            if (job_.points.empty() && states_points()) {
                continue;  // the table of points was refused
            }
            if (job_.points.empty()) {
                problems_.refuse(k_point_without_limit, where, name + " states limits of points, and there are none",
                                 "limits that differ from point to point need a table of points",
                                 "state \"lower\" and \"upper\" in place of \"limits\"");
                continue;
            }
            std::vector<std::string> without, past;
            std::string problem;
            std::optional<double> end;
            bool is_past_all = false;  // a point without limits is a little past a step of them
            for (std::size_t p = 0; p < points.points.size() && problems_.refusals() == 0; ++p) {
                if (!is_about(s, p)) {
                    continue;
                }
                const certificate::LimitsAt limits = certificate::limits_at(s, certificate::lookup_at(points, p));
                if (!limits.problem.empty()) {
                    problem = without.empty() ? limits.problem : problem;
                    without.push_back(text::in_quotes(points.points[p]));
                }
                if (limits.passed && !is_set(s.limits->arguments.front().of)) {
                    end = end ? end : limits.passed;
                    is_past_all = is_past_all || !limits.problem.empty();
                    past.push_back(text::in_quotes(points.points[p]));
                }
            }
            if (problems_.refusals() == 0) {
                check_ranges(s, points, name, where);
                check_centre(s, name, where);
            }
            if (!without.empty()) {
                problems_.refuse(k_point_without_limit, where,
                                 name + " has no limits at the point" + (without.size() == 1 ? " " : "s ") +
                                     text::listed(without, 5) + ": " + problem,
                                 "every point has the limits of a specification that names its result",
                                 s.limits->by == "points" ? "state them in the columns limit_low, limit_high or mpe"
                                 : !is_past_all           ? "complete \"limits\" of the specification"
                                                          : k_take_nominal_values);
            } else if (!past.empty()) {
                const certificate::CapabilityArgument& argument = s.limits->arguments.front();
                problems_.warn(k_warn_step_passed, where,
                               name + ": " + text::in_quotes(argument.of) + " passes " + text::shortest(*end) + " " +
                                   argument.unit + ", the end of a step of the limits, by less than 1 % at the point" +
                                   (past.size() == 1 ? " " : "s ") + text::listed(past, 5),
                               "the limits there are those of the next step", k_take_nominal_values);
            }
        }
    }

private:
    [[nodiscard]] std::size_t section_of(std::size_t point) const {
        return gum::section_of_point(job_, point).value_or(0);
    }

    [[nodiscard]] const PointColumn* column(std::string_view name) const {
        return certificate::column_named(job_.point_columns, name);
    }

    [[nodiscard]] certificate::PointTable table_of_points() const {
        certificate::PointTable points;
        for (const gum::BudgetPoint& point : job_.points) {
            points.points.push_back(point.name);
        }
        points.columns = job_.point_columns;
        return points;
    }

    /// Limits that the points state and no specification takes: the verdicts would be those of other limits.
    void warn_of_unused_limits() {
        for (const std::string_view name : certificate::k_limit_columns) {
            const PointColumn* const limits = column(name);
            std::vector<std::string> at;
            for (std::size_t p = 0; limits != nullptr && p < limits->values.size() && p < job_.points.size(); ++p) {
                const auto takes = [&](const certificate::AgreedSpecification& s) {
                    const std::vector<std::string> names =
                        s.limits ? certificate::columns_of_limits(*s.limits) : std::vector<std::string>();
                    return is_about(s, p) && ((s.limits && s.limits->by == "points") ||
                                              std::find(names.begin(), names.end(), name) != names.end());
                };
                const auto& specifications = job_.certificate->specifications;
                if (limits->values[p] && std::none_of(specifications.begin(), specifications.end(), takes)) {
                    at.push_back(text::in_quotes(job_.points[p].name));
                }
            }
            if (!at.empty()) {
                problems_.warn(k_warn_extra_column, document_.where("/certificate"),
                               "the column " + text::in_quotes(name) + " states limits of the point" +
                                   (at.size() == 1 ? " " : "s ") + text::listed(at, 5) +
                                   ", and no specification takes them",
                               "limits of points hold where \"limits\" of a specification are {\"by\": \"points\"}",
                               "state that in the specification, or remove the column");
            }
        }
    }

    /// Whether a specification names a result that a point has.
    [[nodiscard]] bool is_about(const certificate::AgreedSpecification& s, std::size_t point) const {
        const auto& results = results_[section_of(point)];
        return std::any_of(results.begin(), results.end(), [&](const auto& known) {
            return certificate::is_named(s.results, known.first) ||
                   certificate::is_named(s.results, known.first + "[" + job_.points[point].name + "]");
        });
    }

    /// Whether the job states points, which may have been refused.
    [[nodiscard]] bool states_points() const {
        const json& job = document_.value;
        const auto sections = job.find("sections");
        return job.contains("points") || (sections != job.end() && sections->is_object() &&
                                          std::any_of(sections->begin(), sections->end(), [](const json& one) {
                                              return one.is_object() && one.contains("points");
                                          }));
    }

    /// The accuracy of a range that no point has: where an entry without a range takes its points, a slip of the pen
    /// would give them the limits of another range, without a word.
    void check_ranges(const certificate::AgreedSpecification& s, const certificate::PointTable& points,
                      const std::string& name, const std::string& where) {
        const auto& accuracy = s.limits->accuracy;
        std::set<std::string> stated;
        for (const auto& entry : accuracy) {
            if (!entry.range.empty() && !stated.insert(entry.range).second) {
                problems_.refuse(k_limits_not_meant, where,
                                 name + " states the accuracy of the range " + text::in_quotes(entry.range) + " twice",
                                 "the first entry that fits a point is taken", "keep the one that was agreed");
                return;
            }
        }
        const auto open = std::find_if(accuracy.begin(), accuracy.end(), [](const auto& a) { return a.range.empty(); });
        if (open == accuracy.end()) {
            return;  // a range that is not stated is a point without limits
        }
        if (std::next(open) != accuracy.end()) {
            problems_.refuse(k_limits_not_meant, where,
                             name + " states an accuracy behind the one without a range, which is taken first",
                             "the first entry that fits a point is taken, and one without a range fits all",
                             "state the accuracy without a range last, and once");
            return;
        }
        std::set<std::string> taken;  // words of points that no entry names
        std::set<std::string> words;
        std::vector<std::string> at;
        for (std::size_t p = 0; p < points.points.size(); ++p) {
            if (!is_about(s, p)) {
                continue;
            }
            const std::string word = certificate::lookup_at(points, p).word(s.limits->range_column);
            words.insert(word);
            if (std::none_of(accuracy.begin(), open, [&](const auto& a) { return a.range == word; })) {
                taken.insert(word);
                at.push_back(text::in_quotes(points.points[p]));
            }
        }
        // Blanks, and capitals but for M and m, which are two prefixes: "1 MΩ" is no slip for "1 mΩ".
        const auto letters = [](const std::string& word) {
            std::string some;
            for (const char c : word) {
                if (c != ' ') {
                    some += static_cast<char>(c >= 'A' && c <= 'Z' && c != 'M' ? c - 'A' + 'a' : c);
                }
            }
            return some;
        };
        for (auto entry = accuracy.begin(); entry != open && !taken.empty(); ++entry) {
            if (words.contains(entry->range)) {
                continue;
            }
            const auto meant = std::find_if(taken.begin(), taken.end(), [&](const std::string& word) {
                return letters(word) == letters(entry->range);
            });
            const std::string what = name + " states the accuracy of the range " + text::in_quotes(entry->range);
            if (meant != taken.end()) {
                problems_.refuse(k_limits_not_meant, where, what + ", and points have " + text::in_quotes(*meant),
                                 "a range is the word that the points have", "write it as the points have it");
            } else {
                problems_.warn(k_warn_range_of_no_point, where,
                               what + ", which no point has; that without a range holds for the point" +
                                   (at.size() == 1 ? " " : "s ") + text::listed(at, 5),
                               "the first entry that fits a point is taken, and one without a range fits all",
                               "see whether these points are meant, and correct the range");
            }
        }
    }

    /// Limits about a nominal value are those of a measured value: an error lies near 0.
    void check_centre(const certificate::AgreedSpecification& s, const std::string& name, const std::string& where) {
        const PointColumn* const centre = column(s.limits->about);
        constexpr std::array<std::string_view, 3> k_differences{"error", "deviation", "correction"};
        const auto is_difference = [&](const std::string& role) {
            return std::find(k_differences.begin(), k_differences.end(), role) != k_differences.end();
        };
        if (centre == nullptr || centre->role.empty() || is_difference(centre->role)) {
            return;
        }
        for (const auto& [result, part] : job_.output_parts) {
            const bool is_meant =
                std::any_of(s.results.begin(), s.results.end(), [&, of = result](const std::string& stated) {
                    return certificate::is_named({stated}, of) || stated.starts_with(of + "[");
                });
            if (is_meant && is_difference(part.role)) {
                problems_.refuse(k_limits_not_meant, where,
                                 name + " has limits about " + text::in_quotes(centre->name) + ", and " +
                                     text::in_quotes(result) + " has the role " + text::in_quotes(part.role),
                                 "limits of an error, a deviation or a correction lie about 0",
                                 "leave \"about\" out, or name the measured value in \"results\"");
                return;
            }
        }
    }

    /// Whether a column or an input is what was meant to be, not what was measured.
    [[nodiscard]] bool is_set(const std::string& name) const {
        const PointColumn* const c = column(name);
        const auto i =
            std::find_if(job_.inputs.begin(), job_.inputs.end(), [&](const auto& one) { return one.name == name; });
        const auto is_constant = [](const gum::StatedQuantity& part) { return part.statement == "constant"; };
        return (c != nullptr && (c->role == "nominal" || c->role == "setting")) ||
               (i != job_.inputs.end() && !i->components.empty() &&
                std::all_of(i->components.begin(), i->components.end(), is_constant));
    }

    const JsonDocument& document_;
    const BudgetJob& job_;
    const ResultsOfSections& results_;
    ProblemList& problems_;
};

}  // namespace

void check_point_limits(const JsonDocument& document, const BudgetJob& job, const ResultsOfSections& results,
                        ProblemList& problems) {
    PointLimitChecks(document, job, results, problems).check();
}

}  // namespace gumcert::jobs
