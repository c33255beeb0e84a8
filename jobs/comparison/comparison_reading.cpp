#include "jobs/comparison/comparison_reading.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "gum/coverage.h"
#include "gum/quantity/dense_factors.h"
#include "jobs/budget/budget_results.h"
#include "jobs/comparison/comparison_statement.h"
#include "jobs/job_limits.h"
#include "jobs/job_reader.h"
#include "text/counts.h"
#include "text/numbers.h"
#include "text/small_letters.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

namespace {

using nlohmann::json;

constexpr std::string_view k_infinite = "inf";
constexpr double k_infinitely_many = std::numeric_limits<double>::infinity();

/// u, U, k and nu of one result as they are stated, before they are looked at together.
struct StatedUncertainty {
    std::optional<double> u = {}, U = {}, k = {}, nu = {};
    bool has_u = false, has_U = false, has_k = false, has_nu = false;  ///< stated, perhaps not readable

    [[nodiscard]] bool is_stated() const { return has_u || has_U || has_k || has_nu; }
    [[nodiscard]] bool is_readable() const { return (has_U ? U && k : u.has_value()) && (!has_nu || nu); }
};

/// Keys that must stand together, and do not.
struct UncertaintyObjection {
    const InputCode* code = nullptr;
    std::string_view key;
    std::string what, rule, action;
};

std::optional<UncertaintyObjection> objection(const StatedUncertainty& stated) {
    if (stated.has_u && (stated.has_U || stated.has_k)) {
        return UncertaintyObjection{&k_u_and_expanded_u, stated.has_U ? "U" : "k",
                                    stated.has_U ? "\"u\" and \"U\" are given together"
                                                 : "a coverage factor \"k\" beside the standard uncertainty \"u\"",
                                    "a result states u, or U with k", "keep one of the two statements"};
    }
    if (stated.has_U && !stated.has_k) {
        return UncertaintyObjection{&k_no_coverage_factor, "U", "\"U\" without its coverage factor \"k\"",
                                    "an expanded uncertainty means something only with its coverage factor",
                                    "add \"k\" from the certificate, or state the standard uncertainty as \"u\""};
    }
    if (stated.has_k && !stated.has_U) {
        return UncertaintyObjection{&k_no_coverage_factor, "k",
                                    "a coverage factor \"k\" without an expanded uncertainty", "k belongs to U",
                                    "add \"U\", or remove \"k\""};
    }
    if (!stated.has_u && !stated.has_U) {
        return UncertaintyObjection{&k_degrees_of_freedom_of_nothing, "nu",
                                    "degrees of freedom \"nu\" without an uncertainty",
                                    "nu belongs to u, or to U and k", "add \"u\", or remove \"nu\""};
    }
    return std::nullopt;
}

/// U = t_p(ν) u where u is stated, u = U/k else.
/// \param stated  without objection, its numbers read
/// \return nothing when no coverage factor exists for its degrees of freedom
std::optional<gum::ResultUncertainty> evaluate(const StatedUncertainty& stated, double coverage_probability) {
    gum::ResultUncertainty uncertainty;
    uncertainty.degrees_of_freedom = stated.nu.value_or(uncertainty.degrees_of_freedom);
    uncertainty.stated_as_expanded = stated.has_U;
    if (stated.has_U) {
        uncertainty.U = stated.U.value();
        uncertainty.k = stated.k.value();
        uncertainty.u = uncertainty.U / uncertainty.k;
    } else {
        try {
            uncertainty.u = stated.u.value();
            uncertainty.k = gum::coverage_factor(coverage_probability, uncertainty.degrees_of_freedom);
            uncertainty.U = uncertainty.k * uncertainty.u;
        } catch (const gum::DiagnosedError&) {
            return std::nullopt;
        }
    }
    const NumberRange range = between(k_least_compared_u, k_largest_compared, "");
    return range.contains(uncertainty.u) && range.contains(uncertainty.U) ? std::optional{uncertainty} : std::nullopt;
}

/// \param where  tells the place of a key
template <typename Where>
std::optional<gum::ResultUncertainty> evaluate(const StatedUncertainty& stated, double coverage_probability,
                                               ProblemList& problems, const Where& where) {
    if (!stated.is_stated()) {
        return std::nullopt;
    }
    if (const auto found = objection(stated)) {
        problems.refuse(*found->code, where(found->key), found->what, found->rule, found->action);
        return std::nullopt;
    }
    if (stated.k &&
        is_unusual_coverage_factor(*stated.k, stated.nu.value_or(std::numeric_limits<double>::infinity()))) {
        problems.warn(k_warn_unusual_coverage_factor, where("k"),
                      "a coverage factor of " + text::shortest_plain(*stated.k),
                      "U = k u with k about 2 for a coverage probability of 95 %",
                      "check that it is the coverage factor and not the coverage probability");
    }
    if (!stated.is_readable()) {
        return std::nullopt;
    }
    const auto uncertainty = evaluate(stated, coverage_probability);
    if (!uncertainty) {
        problems.refuse(k_not_representable, where(stated.has_U ? "U" : "u"),
                        "an uncertainty, or its coverage factor, beyond what the program computes with",
                        "u and U lie between 1e-60 and 1e60, and nu is large enough for a coverage factor to exist",
                        "check the numbers, and choose a unit in which they are moderate");
    }
    return uncertainty;
}

}  // namespace

// ---- budgets --------------------------------------------------------------------------------------------------------

std::shared_ptr<const BudgetJob> ComparisonBudgets::read(const std::string& name) {
    if (const auto found = read_.find(name); found != read_.end()) {
        return found->second;
    }
    std::shared_ptr<const BudgetJob>& budget = read_[name];
    const std::optional<JobFiles::File> file = files_.open(name);
    if (!file) {
        return nullptr;
    }
    try {
        budget = std::make_shared<const BudgetJob>(read_undivided_budget_job(source_, file->problems->file()));
        files_.add(budget->files, budget->warnings);
    } catch (const gum::InputError& error) {
        files_.add(error);
    } catch (const gum::StorageError& error) {
        files_.add(error);
    }
    return budget;
}

void refuse_other_results(const BudgetJob& budget, const gum::Unit& wanted, const std::string& where,
                          ProblemList& problems) {
    const auto results = budget_results(budget);
    const auto is_of_kind = [&](const gum::Unit& unit) {
        return unit.dimension() == wanted.dimension() &&
               unit.is_celsius_temperature() == wanted.is_celsius_temperature();
    };
    if (results.size() == 1 && is_of_kind(results.front().second)) {
        return;
    }
    std::vector<std::string> units;
    for (const auto& [name, unit] : results) {
        units.push_back(unit.text());
    }
    problems.refuse(k_comparison_budget, where,
                    units.size() == 1
                        ? "the result of the budget has the unit " + text::in_quotes(units.front())
                        : "the budget has " + text::count_of(units.size(), "result") + ", in " + list_of(units),
                    "it has one result, of a unit of the same kind as " + text::in_quotes(wanted.text()),
                    "state one output in the budget, or correct the unit of the comparison");
}

// ---- labels ---------------------------------------------------------------------------------------------------------

std::string LabelIndex::advice(std::string_view label, std::string otherwise) const {
    std::vector<std::string_view> known;
    for (const auto& [name, position] : positions_) {
        known.push_back(name);
    }
    std::sort(known.begin(), known.end());  // the order of a hash table is no order for a message
    const std::optional<std::string_view> nearest = nearest_word(label, known);
    return nearest ? "did you mean " + text::in_quotes(*nearest) + "?" : otherwise;
}

std::optional<JsonObject> object_at(const ComparisonReading& reading, const std::string& pointer,
                                    std::span<const std::string_view> keys,
                                    std::span<const std::string_view> keys_and_bare) {
    const json& value = reading.document.value.at(json::json_pointer(pointer));
    if (!value.is_object()) {
        if (!value.is_discarded()) {
            reading.problems.refuse(k_wrong_type, reading.document.where(pointer), described(value),
                                    "must be an object", "write { \"key\": value, … }");
        }
        return std::nullopt;
    }
    if (keys_and_bare.empty() || !value.contains(k_bare_key)) {
        return JsonObject(reading.document, pointer, keys, reading.problems);
    }
    reading.problems.refuse(k_bare_uncertainty, reading.document.where(child_pointer(pointer, k_bare_key)),
                            "\"uncertainty\" does not say which uncertainty it is",
                            "a standard uncertainty is \"u\", an expanded one is \"U\" with its coverage factor \"k\"",
                            "write \"u\", or \"U\" and \"k\"");
    return JsonObject(reading.document, pointer, keys_and_bare, reading.problems);
}

// ---- uncertainties --------------------------------------------------------------------------------------------------

bool states_uncertainty(const JsonObject& object) {
    return object.has("u") || object.has("U") || object.has("k");
}

std::optional<gum::ResultUncertainty> of_standard_uncertainty(double u, double coverage_probability) {
    return evaluate({.u = u, .has_u = true}, coverage_probability);
}

std::optional<gum::ResultUncertainty> read_uncertainty(const ComparisonReading& reading, const JsonObject& object) {
    StatedUncertainty stated;
    stated.has_u = object.has("u");
    stated.has_U = object.has("U");
    stated.has_k = object.has("k");
    stated.has_nu = object.has("nu");
    stated.u = object.optional_number("u", k_compared_uncertainty);
    stated.U = object.optional_number("U", k_compared_uncertainty);
    stated.k = object.optional_number("k", k_coverage_factor);
    if (const json* nu = object.find("nu"); nu != nullptr && nu->is_string() && *nu == k_infinite) {
        stated.nu = k_infinitely_many;
    } else {
        stated.nu = object.optional_number("nu", above_zero(""));
    }
    return evaluate(stated, reading.job.coverage_probability, reading.problems,
                    [&](std::string_view key) { return object.where(key); });
}

namespace {

/// Whether the header of a column says that it holds uncertainties, in a word or as the symbol: "Unsicherheit", "U95",
/// "U (k=2)", "u_c".
bool names_uncertainty(std::string_view header) {
    const std::string small = text::in_small_letters(header);
    for (const std::string_view word : {"uncert", "unsicher", "incert", "不確定", "不确定"}) {
        if (small.find(word) != std::string::npos) {
            return true;
        }
    }
    const bool is_symbol = small.starts_with('u') && (small.size() == 1 || small[1] < 'a' || small[1] > 'z');
    return is_symbol || small == "uc";
}

/// Columns that would be used under another name: what they say must not be lost behind a warning.
bool check_unused_columns(const CsvTable& table, const UncertaintyColumns& columns, bool states_uncertainty,
                          ProblemList& problems) {
    const std::vector<std::string_view> missing = table.missing_columns();
    bool is_fine = true;
    for (const CsvCell& header : table.unused_columns()) {
        const std::string small = text::in_small_letters(header.text);
        // One letter may be a quantity of its own: N beside n, S beside s.
        const auto twin = std::find_if(missing.begin(), missing.end(), [&](std::string_view name) {
            return name.size() > 1 && name != k_bare_key && text::in_small_letters(name) == small &&
                   std::find(columns.idle.begin(), columns.idle.end(), name) == columns.idle.end();
        });
        if (twin != missing.end()) {
            problems.refuse(
                k_column_in_capitals, table.where(header),
                "the column " + text::in_quotes(header.text) + " is not known, and " + text::in_quotes(*twin) + " is",
                "columns are known by their names, letter by letter",
                "rename the column, or remove it where it means something else");
            is_fine = false;
        } else if (!states_uncertainty && names_uncertainty(header.text)) {
            problems.refuse(k_bare_uncertainty, table.where(header),
                            "the column " + text::in_quotes(header.text) + " does not say which uncertainty it is",
                            "a standard uncertainty is u, an expanded one is U with its coverage factor k",
                            "name the column u, or U with a column k; remove it where it is neither");
            is_fine = false;
        }
    }
    return is_fine;
}

/// Spreadsheets pad cells, with blanks that do not break as well.
std::string_view without_blanks_around(std::string_view text) {
    constexpr std::string_view k_no_break = "\xC2\xA0";
    for (std::size_t before = text.size() + 1; before != text.size();) {
        before = text.size();
        for (const std::string_view blank : {std::string_view(" "), std::string_view("\t"), k_no_break}) {
            text.remove_prefix(text.starts_with(blank) ? blank.size() : 0);
            text.remove_suffix(text.ends_with(blank) ? blank.size() : 0);
        }
    }
    return text;
}

bool is_dash(std::string_view text) {
    return text == "-" || text == "–" || text == "—";
}

/// Whether a number means the same in both units.
bool is_same_unit(const gum::Unit& a, const gum::Unit& b) {
    return gum::of_one_kind(a, b) && a.to_si(0.0) == b.to_si(0.0) &&
           std::abs(a.difference_to_si(1.0) / b.difference_to_si(1.0) - 1.0) <= k_same_number;
}

}  // namespace

void check_unit_of_row(const CsvTable& table, std::size_t row, std::size_t column, const gum::Unit& wanted,
                       std::string_view of, ProblemList& problems) {
    if (!is_stated(table, row, column)) {
        return;
    }
    const CsvCell& cell = table.cell(row, column);
    const std::string_view unit = without_blanks_around(cell.text);
    bool is_same = unit.empty() || unit == wanted.text() || is_dash(unit);  // a dash states nothing
    try {
        is_same = is_same || is_same_unit(gum::Unit::parse(unit), wanted);
    } catch (const gum::InputError&) {
        is_same = false;  // what is no unit is not that of the values
    }
    if (!is_same) {
        problems.refuse(k_unit_of_value, table.where(cell), "the unit " + text::in_quotes(cell.text),
                        "values and uncertainties are stated in the unit of " + std::string(of) + ", " +
                            text::in_quotes(wanted.text()) + ", and nothing is converted",
                        "convert value and uncertainty, or correct the unit of the row or of the job");
    }
}

bool check_uncertainty_columns(const CsvTable& table, const UncertaintyColumns& columns, ProblemList& problems,
                               bool has_others) {
    if (table.rows() == 0) {
        return false;
    }
    const bool states_uncertainty =
        has_others || table.has_column(columns.u) || table.has_column(columns.U) || table.has_column(columns.bare);
    if (!check_unused_columns(table, columns, states_uncertainty, problems)) {
        return false;
    }
    if (table.has_column(columns.bare)) {
        problems.refuse(k_bare_uncertainty, table.where(table.cell(0, columns.bare)),
                        "the column \"uncertainty\" does not say which uncertainty it is",
                        "a standard uncertainty is u, an expanded one is U with its coverage factor k",
                        "name the column u, or U with a column k");
        return false;
    }
    const std::size_t lonely = table.has_column(columns.U) ? columns.U : columns.k;
    if (table.has_column(columns.U) != table.has_column(columns.k)) {
        problems.refuse(k_no_coverage_factor, table.where(table.cell(0, lonely)),
                        table.has_column(columns.U) ? "a column U without a column k" : "a column k without a column U",
                        "an expanded uncertainty means something only with its coverage factor",
                        table.has_column(columns.U) ? "add a column k, or state standard uncertainties in a column u"
                                                    : "name the column of expanded uncertainties U");
        return false;
    }
    return true;
}

std::optional<gum::ResultUncertainty> read_uncertainty(const CsvTable& table, std::size_t row,
                                                       const UncertaintyColumns& columns, double coverage_probability,
                                                       ProblemList& problems) {
    StatedUncertainty stated;
    stated.has_u = is_stated(table, row, columns.u);
    stated.has_U = is_stated(table, row, columns.U);
    stated.has_k = is_stated(table, row, columns.k);
    stated.has_nu = is_stated(table, row, columns.nu);
    stated.u = table.number_if_any(row, columns.u, k_compared_uncertainty);
    stated.U = table.number_if_any(row, columns.U, k_compared_uncertainty);
    stated.k = table.number_if_any(row, columns.k, k_coverage_factor);
    stated.nu = stated.has_nu && table.cell(row, columns.nu).text == k_infinite
                    ? std::optional{k_infinitely_many}
                    : table.number_if_any(row, columns.nu, above_zero(""));
    return evaluate(stated, coverage_probability, problems, [&](std::string_view key) {
        const std::size_t column = key == "u"   ? columns.u
                                   : key == "U" ? columns.U
                                   : key == "k" ? columns.k
                                                : columns.nu;
        return table.where(table.cell(row, column));
    });
}

// ---- values ---------------------------------------------------------------------------------------------------------

/// "<0.3" and ">5": results that state no value.
bool is_censored(std::string_view text) {
    return text.starts_with('<') || text.starts_with('>') || text.starts_with("≤") || text.starts_with("≥");
}

void refuse_censored(std::string_view text, const std::string& where, std::string_view if_none, ProblemList& problems) {
    problems.refuse(k_censored_result, where, "the result " + text::in_quotes(text) + " is a limit and no value",
                    "scores and means need the value that was measured",
                    "report what was measured, with its uncertainty, or " + std::string(if_none));
}

std::optional<double> read_value(const ComparisonReading& reading, const JsonObject& object, std::string_view if_none) {
    const json* value = object.find("value");
    if (value == nullptr || !value->is_string()) {
        return object.optional_number("value", k_compared_value);
    }
    const auto& text = value->get_ref<const std::string&>();
    if (is_censored(text)) {
        refuse_censored(text, object.where("value"), if_none, reading.problems);
    } else {
        object.refuse(k_wrong_type, "value", described(*value), "must be a number",
                      "write the number with a decimal point and without quotes, or " + std::string(if_none));
    }
    return std::nullopt;
}

std::optional<double> read_value(const CsvTable& table, std::size_t row, std::size_t column, std::string_view if_none,
                                 ProblemList& problems) {
    const CsvCell& cell = table.cell(row, column);
    if (is_censored(cell.text)) {
        refuse_censored(cell.text, table.where(cell), if_none, problems);
        return std::nullopt;
    }
    // What people write for "no result": NA, n/a, ND, -.
    if (!cell.text.empty() && cell.text.find_first_of("0123456789") == std::string_view::npos) {
        problems.refuse(k_csv_not_a_number, table.where(cell), text::in_quotes(cell.text) + " in column value",
                        "must be a number with a decimal point", "state the value, or " + std::string(if_none));
        return std::nullopt;
    }
    return table.number(row, column, k_compared_value);
}

// ---- sources --------------------------------------------------------------------------------------------------------

std::vector<gum::UncertaintySource> read_sources(const ComparisonReading& reading, const JsonObject& object,
                                                 const std::optional<double>& u) {
    std::vector<gum::UncertaintySource> sources;
    const json* array = object.optional_array("sources");
    if (array == nullptr) {
        return sources;
    }
    double sum = 0.0;
    for_each_object(reading, *array, object.pointer("sources"), keys_of<gum::UncertaintySource>(), {},
                    [&](const JsonObject& entry) {
                        gum::UncertaintySource part;
                        JobReader reader(entry);
                        reader.read(part);
                        if (!reader.accepted("source") || !reader.accepted("u")) {
                            return;
                        }
                        if (std::any_of(sources.begin(), sources.end(),
                                        [&](const auto& other) { return other.source == part.source; })) {
                            entry.refuse(k_repeated_source, "source",
                                         "the source " + text::in_quotes(part.source) + " occurs twice",
                                         "a result states one part for each source",
                                         "add the parts up, with their signs");
                            return;
                        }
                        sum = std::hypot(sum, part.contribution);
                        sources.push_back(std::move(part));
                    });
    if (u && sum > *u * (1.0 + k_same_number)) {
        object.refuse(
            k_parts_exceed_uncertainty, "sources",
            "the parts add up to " + text::shortest_plain(sum) + ", and u of the result is " + text::shortest_plain(*u),
            "parts of an uncertainty are at most as large as the whole",
            "state the parts as standard uncertainties of the result, or correct its uncertainty");
    }
    return sources;
}

// ---- arrays and matrices --------------------------------------------------------------------------------------------

std::optional<Eigen::MatrixXd> read_rows(const ComparisonReading& reading, const JsonObject& object,
                                         std::string_view key, std::size_t least_rows, std::size_t least_columns) {
    const json* rows = object.optional_array(key);
    if (rows == nullptr) {
        return std::nullopt;
    }
    if (rows->size() < least_rows) {
        object.refuse(k_wrong_size, key, text::count_of(rows->size(), "row"),
                      "there must be at least " + std::to_string(least_rows), "write one array a row");
        return std::nullopt;
    }
    const std::size_t columns = (*rows)[0].is_array() ? (*rows)[0].size() : least_columns;
    Eigen::MatrixXd matrix(static_cast<Eigen::Index>(rows->size()), static_cast<Eigen::Index>(columns));
    bool is_read = true;
    for (std::size_t i = 0; i < rows->size(); ++i) {
        const std::string pointer = child_pointer(object.pointer(key), i);
        const json& row = (*rows)[i];
        const auto refuse = [&](const InputCode& code, const std::string& what, const std::string& rule) {
            reading.problems.refuse(code, reading.document.where(pointer), what, rule, "correct the row");
            is_read = false;
        };
        if (!row.is_array()) {
            if (!row.is_discarded()) {
                refuse(k_wrong_type, described(row), "must be an array of numbers");
            }
            is_read = false;
            continue;
        }
        if (row.size() < least_columns) {
            refuse(k_wrong_size, "a row of " + std::to_string(row.size()) + " numbers",
                   "there must be at least " + std::to_string(least_columns));
            continue;
        }
        if (row.size() != columns) {
            refuse(
                k_ragged_replicates,
                "a row of " + std::to_string(row.size()) + " numbers, and the first one has " + std::to_string(columns),
                "all rows have equally many numbers");
            continue;
        }
        for (std::size_t j = 0; j < columns; ++j) {
            const NumberRange& range = k_compared_value;
            if (!row[j].is_number() || !range.contains(row[j].get<double>())) {
                is_read = false;
                if (!row[j].is_discarded()) {
                    reading.problems.refuse(row[j].is_number() ? k_number_out_of_range : k_wrong_type,
                                            reading.document.where(child_pointer(pointer, j)), described(row[j]),
                                            row[j].is_number() ? range.rule() : "must be a number",
                                            "correct the value");
                }
                continue;
            }
            matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = row[j].get<double>();
        }
    }
    return is_read ? std::optional{std::move(matrix)} : std::nullopt;
}

std::string list_of(const std::vector<std::string>& names, std::size_t most) {
    std::string text;
    const std::size_t shown = std::min(names.size(), most);
    for (std::size_t i = 0; i < shown; ++i) {
        text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + text::in_quotes(names[i]);
    }
    return names.size() > shown ? text + " and " + std::to_string(names.size() - shown) + " more" : text;
}

std::optional<NegativeEigenvalue> negative_eigenvalue(const Eigen::MatrixXd& correlation) {
    if (const Eigen::LLT<Eigen::MatrixXd> factor(correlation); factor.info() == Eigen::Success) {
        return std::nullopt;
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(correlation);
    const Eigen::Index n = correlation.rows();
    NegativeEigenvalue found;
    found.eigenvalue = solver.eigenvalues()(0);
    // Numbers with the digits that people write must not be refused for their rounding.
    if (found.eigenvalue >= -k_same_number * solver.eigenvalues()(n - 1)) {
        return std::nullopt;
    }
    const Eigen::VectorXd vector = solver.eigenvectors().col(0);
    std::vector<std::size_t> order(static_cast<std::size_t>(n));
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto part = [&](std::size_t i) { return std::abs(vector(static_cast<Eigen::Index>(i))); };
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return part(a) > part(b) + k_same_number; });
    for (const std::size_t i : order) {
        if (found.culprits.size() < 2 || (found.culprits.size() < 6 && part(i) > 0.1)) {
            found.culprits.push_back(i);
        }
    }
    std::sort(found.culprits.begin(), found.culprits.end());
    return found;
}

std::vector<std::string> read_texts(const ComparisonReading& reading, const JsonObject& object, std::string_view key) {
    std::vector<std::string> texts;
    if (const json* array = object.optional_array(key)) {
        for (std::size_t i = 0; i < array->size(); ++i) {
            const std::string where = reading.document.where(child_pointer(object.pointer(key), i));
            if (auto text = label_of((*array)[i], where, reading.problems)) {
                texts.push_back(std::move(*text));
            }
        }
    }
    return texts;
}

}  // namespace gumcert::jobs
