#include "jobs/budget/budget_fit_statement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "gum/expression/name.h"
#include "gum/expression/syntax_tree.h"
#include "gum/quantity/dense_factors.h"
#include "jobs/budget/budget_statement_fields.h"
#include "jobs/csv_table.h"
#include "jobs/job_limits.h"
#include "jobs/matrix_limits.h"
#include "text/counts.h"
#include "text/lists.h"
#include "text/numbers.h"
#include "text/place.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

namespace {

using nlohmann::json;

bool contains(const std::vector<std::string>& names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// Reads one fit.
class FitReader {
public:
    FitReader(const JsonObject& object, std::string pointer, const JsonDocument& document, JobFiles& files,
              ProblemList& problems)
        : object_(object), pointer_(std::move(pointer)), document_(document), files_(files), problems_(problems) {}

    /// \param taken  names that no parameter may have; those of this fit are added
    gum::BudgetFit read(const std::string& name, std::map<std::string, std::string>& taken) {
        fit_.name = name;
        fit_.where = object_.where();
        const std::size_t problems_before = problems_.refusals();
        read_parameters(taken);
        fit_.scale_by_residuals = object_.optional_boolean("scale_by_residuals").value_or(false);
        if (read_equation() && read_units() && read_data()) {
            read_covariances();
            if (problems_.refusals() == problems_before) {
                check_counts();
                check_uncertainties();
                check_equation();
            }
        }
        return std::move(fit_);
    }

private:
    void read_parameters(std::map<std::string, std::string>& taken) {
        const json* parameters = object_.require("parameters") ? object_.find("parameters") : nullptr;
        if (parameters == nullptr) {
            return;
        }
        if (!parameters->is_object() || parameters->empty()) {
            object_.refuse(k_wrong_type, "parameters", described(*parameters),
                           "must be an object with at least one parameter", "state the parameters of the equation");
            return;
        }
        const std::string at = object_.pointer("parameters");
        for (const std::string& name : keys_in_order(document_, at)) {
            const std::string here = child_pointer(at, name);
            if (!parameters->at(name).is_object()) {
                problems_.refuse(k_wrong_type, document_.where(here), described(parameters->at(name)),
                                 "must be an object", "write {} for a parameter of unit 1 without a start value");
                continue;
            }
            const JsonObject parameter(document_, here, keys_of<ParameterStatement>(), problems_);
            const auto unit = read_unit(parameter, "unit", problems_);
            const auto start = parameter.optional_number("start");
            const bool is_name = is_quantity_name(name, document_.where(here), problems_);
            const auto [entry, is_new] =
                taken.try_emplace(name, "a parameter of the fit " + text::in_quotes(fit_.name));
            if (!is_new) {
                problems_.refuse(k_name_of_two, document_.where(here),
                                 text::in_quotes(name) + " is also " + entry->second, "a name stands for one quantity",
                                 "rename one of the two");
            }
            if (unit && is_name) {
                gum::BudgetFit::Parameter& read = fit_.parameters.emplace_back();
                read.name = name;
                read.unit = *unit;
                if (start) {
                    read.start = unit->to_si(*start);
                }
            }
        }
    }

    bool read_equation() {
        const json* text = object_.require("equation") ? object_.find("equation") : nullptr;
        const auto equation =
            text == nullptr ? std::nullopt : equation_text_of(*text, object_.where("equation"), problems_);
        if (!equation) {
            return false;
        }
        fit_.equation = *equation;
        gum::EquationNames names;
        try {
            names = gum::equation_names(*equation);
        } catch (const gum::DiagnosedError& error) {
            refuse_as(error, "", problems_);
            return false;
        }
        if (names.defines.empty()) {
            object_.refuse(k_fit_name, "equation", text::in_quotes(equation->text),
                           "the left side of the equation of a fit is the quantity that was observed",
                           "write it as name = expression");
            return false;
        }
        fit_.ordinate = names.defines;
        uses_ = names.uses;
        return true;
    }

    [[nodiscard]] bool is_parameter(std::string_view name) const {
        return std::any_of(fit_.parameters.begin(), fit_.parameters.end(),
                           [&](const gum::BudgetFit::Parameter& parameter) { return parameter.name == name; });
    }

    /// Regressors are the names of the right side that are no parameters.
    [[nodiscard]] bool data_have(const std::string& column) const {
        const json* data = object_.find("data");
        return data != nullptr && data->is_object() && data->contains(column);
    }

    bool read_units() {
        const json* parameters = object_.find("parameters");
        for (const std::string& name : uses_) {
            if (name == "rad" && !data_have(name)) {
                continue;  // the constant of the equation language
            }
            const bool is_stated = parameters != nullptr && parameters->is_object() && parameters->contains(name);
            if (!is_parameter(name) && !is_stated && !contains(fit_.regressors, name)) {
                fit_.regressors.push_back(name);
            }
        }
        columns_ = fit_.regressors;
        columns_.push_back(fit_.ordinate);
        std::vector<std::string_view> keys(columns_.begin(), columns_.end());
        const auto units = object_.optional_object("units", keys);
        if (object_.has("units") && !units) {
            return false;
        }
        for (const std::string& name : columns_) {
            const auto unit = units ? read_unit(*units, name, problems_) : std::optional{gum::Unit()};
            if (!unit) {
                return false;
            }
            units_.push_back(*unit);
        }
        fit_.ordinate_unit = units_.back();
        fit_.regressor_units.assign(units_.begin(), units_.end() - 1);
        return true;
    }

    // ---- data -------------------------------------------------------------------------------------------------------

    /// The key `data`: arrays by name, or a file with columns of these names.
    bool read_data() {
        const json* data = object_.require("data") ? object_.find("data") : nullptr;
        if (data == nullptr) {
            return false;
        }
        if (!data->is_object()) {
            object_.refuse(k_wrong_type, "data", described(*data), "must be an object",
                           "give an array for every column, or {\"file\": \"data.csv\"}");
            return false;
        }
        std::vector<std::string> uncertainties;
        for (const std::string& name : columns_) {
            uncertainties.push_back("u_" + name);
        }
        const bool has_file = data->contains("file") && !contains(columns_, "file");
        std::vector<std::string_view> keys;
        if (has_file) {
            keys.emplace_back("file");
        } else {
            keys.insert(keys.end(), columns_.begin(), columns_.end());
        }
        keys.insert(keys.end(), uncertainties.begin(), uncertainties.end());
        const std::size_t problems_before = problems_.refusals();
        const auto object = object_.optional_object("data", keys);
        if (problems_.refusals() != problems_before) {
            explain_unknown_columns(*data);
            return false;
        }
        std::vector<std::vector<double>> values(2 * columns_.size());
        const bool is_read = has_file ? read_file(*object, uncertainties, values) : read_arrays(*object, values);
        // A number is the same uncertainty for every point.
        for (std::size_t i = 0; i < uncertainties.size(); ++i) {
            const json* u = object->find(uncertainties[i]);
            if (u == nullptr) {
                continue;
            }
            if (!values[columns_.size() + i].empty()) {
                object->refuse(k_fit_uncertainty, uncertainties[i],
                               text::in_quotes(uncertainties[i]) + " is a column as well",
                               "an uncertainty is stated once", "remove one of the two");
                return false;
            }
            if (u->is_array()) {
                if (!numbers(*u, object->pointer(uncertainties[i]), values[columns_.size() + i])) {
                    return false;
                }
            } else if (const auto number = object->optional_number(uncertainties[i], above_zero(""))) {
                values[columns_.size() + i].assign(values[columns_.size() - 1].size(), *number);
            } else {
                return false;
            }
        }
        return is_read && store(values, uncertainties, *object);
    }

    /// An unknown key of the data that the equation may have meant is worth a second sentence.
    void explain_unknown_columns(const json& data) {
        for (const std::string& name : fit_.regressors) {
            if (!data.contains(name) && !data.contains("file")) {
                object_.refuse(k_fit_name, "equation",
                               text::in_quotes(name) + " is neither a parameter nor a column of the data",
                               "every name on the right side is one of them", "add the column or the parameter");
            }
        }
    }

    bool numbers(const json& array, const std::string& pointer, std::vector<double>& out) {
        bool is_read = true;
        for (std::size_t i = 0; i < array.size(); ++i) {
            if (array[i].is_number()) {
                out.push_back(array[i].get<double>());
                continue;
            }
            is_read = false;
            if (!array[i].is_discarded()) {
                problems_.refuse(k_wrong_type, document_.where(child_pointer(pointer, i)), described(array[i]),
                                 "must be a number", "correct the value");
            }
        }
        return is_read;
    }

    bool read_arrays(const JsonObject& data, std::vector<std::vector<double>>& values) {
        bool is_read = true;
        for (std::size_t i = 0; i < columns_.size(); ++i) {
            if (!data.has(columns_[i])) {
                if (i + 1 < columns_.size()) {
                    object_.refuse(k_fit_name, "equation",
                                   text::in_quotes(columns_[i]) + " is neither a parameter nor a column of the data",
                                   "every name on the right side is one of them", "add the column or the parameter");
                } else {
                    data.require(columns_[i]);
                }
                is_read = false;
                continue;
            }
            const json* array = data.optional_array(columns_[i]);
            is_read = array != nullptr && numbers(*array, data.pointer(columns_[i]), values[i]) && is_read;
            fit_.decimals.push_back(document_.decimals_as_written(data.pointer(columns_[i])));
        }
        return is_read;
    }

    bool read_file(const JsonObject& data, const std::vector<std::string>& uncertainties,
                   std::vector<std::vector<double>>& values) {
        const auto name = JobFiles::file_name(data, "file", true);
        auto file = name ? files_.open(*name) : std::nullopt;
        if (!file) {
            return false;
        }
        const std::vector<CsvHeaderField> header = csv_header(file->bytes);
        bool is_known = true;
        for (const CsvHeaderField& field : header) {
            // A column that looks like an uncertainty must not be passed over in silence.
            if (field.name.starts_with("u_") && !contains(uncertainties, field.name) &&
                !contains(columns_, field.name)) {
                const std::vector<std::string_view> known(uncertainties.begin(), uncertainties.end());
                file->problems->refuse(k_fit_uncertainty, text::where_in_text(file->problems->file(), field.place),
                                       "the column " + text::in_quotes(field.name) + " belongs to no column of the fit",
                                       "uncertainties are in columns " + text::any_of(known), "correct the name");
                is_known = false;
            }
        }
        const std::vector<std::string_view> required(columns_.begin(), columns_.end());
        const std::vector<std::string_view> optional(uncertainties.begin(), uncertainties.end());
        const auto table = read_csv_table(std::move(file->bytes), required, optional, *file->problems);
        if (!table || !is_known) {
            return false;
        }
        bool is_read = table->is_complete();
        for (std::size_t column = 0; column < values.size(); ++column) {
            std::vector<std::string> written;
            for (std::size_t row = 0; table->has_column(column) && row < table->rows(); ++row) {
                const auto number =
                    table->number(row, column, column < columns_.size() ? NumberRange{} : above_zero(""));
                is_read = is_read && number;
                values[column].push_back(number.value_or(0.0));
                written.push_back(table->number_text(row, column));
            }
            if (column < columns_.size()) {
                fit_.decimals.push_back(text::most_decimals(written));
            }
        }
        return is_read;
    }

    bool store(std::vector<std::vector<double>>& values, const std::vector<std::string>& uncertainties,
               const JsonObject& data) {
        const std::size_t n = values[columns_.size() - 1].size();
        const auto rows = static_cast<Eigen::Index>(n);
        const auto q = static_cast<Eigen::Index>(fit_.regressors.size());
        bool fits = true;
        for (std::size_t i = 0; i < values.size(); ++i) {
            const bool is_uncertainty = i >= columns_.size();
            if (values[i].size() == n || (is_uncertainty && values[i].empty())) {
                continue;
            }
            const std::string& name = is_uncertainty ? uncertainties[i - columns_.size()] : columns_[i];
            object_.refuse(k_fit_data, "data",
                           text::in_quotes(name) + " has " + text::count_of(values[i].size(), "value") + ", and " +
                               text::in_quotes(fit_.ordinate) + " has " + std::to_string(n),
                           "all columns have one value a point", "complete the data");
            fits = false;
        }
        if (!fits) {
            return false;
        }
        fit_.x = Eigen::MatrixXd::Zero(rows, q);
        fit_.y = Eigen::VectorXd::Zero(rows);
        for (std::size_t i = 0; i < columns_.size(); ++i) {
            for (std::size_t row = 0; row < n; ++row) {
                const double si = units_[i].to_si(values[i][row]);
                fits = fits && std::isfinite(si);
                (i + 1 < columns_.size() ? fit_.x(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(i))
                                         : fit_.y(static_cast<Eigen::Index>(row))) = si;
            }
        }
        for (std::size_t i = 0; i < columns_.size(); ++i) {
            const std::vector<double>& u = values[columns_.size() + i];
            if (u.empty()) {
                continue;
            }
            const bool is_ordinate = i + 1 == columns_.size();
            if (!is_ordinate && q != 1) {
                data.refuse(
                    k_fit_uncertainty, data.has(uncertainties[i]) ? uncertainties[i] : "file",
                    text::in_quotes(uncertainties[i]) + " is given, and the fit has " + text::count_of(q, "regressor"),
                    "an uncertain regressor must be the only one", "remove the uncertainty");
                return false;
            }
            Eigen::MatrixXd& target = is_ordinate ? fit_.y_uncertainty : fit_.x_uncertainty;
            target = Eigen::MatrixXd::Zero(rows, 1);
            for (std::size_t row = 0; row < n; ++row) {
                const double si = units_[i].difference_to_si(u[row]);
                if (!(si > 1e-140 && si < 1e140)) {
                    data.refuse(u[row] > 0.0 ? k_not_representable : k_number_out_of_range,
                                data.has(uncertainties[i]) ? uncertainties[i] : "file",
                                text::in_quotes(uncertainties[i]) + " of point " + std::to_string(row + 1) + " is " +
                                    text::shortest_plain(u[row]),
                                "a standard uncertainty must be greater than 0", "correct the value");
                    return false;
                }
                target(static_cast<Eigen::Index>(row), 0) = si;
            }
        }
        if (!fits) {
            object_.refuse(k_not_representable, "data", "a value is not finite in coherent SI units",
                           "values must be finite", "check the numbers and the units");
        }
        return fits;
    }

    // ---- covariance of the data -------------------------------------------------------------------------------------

    void read_covariances() {
        std::vector<std::string_view> keys{fit_.ordinate};
        if (fit_.regressors.size() == 1) {
            keys.emplace_back(fit_.regressors.front());
        }
        const auto object = object_.optional_object("covariance", keys);
        if (!object) {
            return;
        }
        for (const std::string_view key : keys) {
            const json* value = object->find(key);
            if (value == nullptr) {
                continue;
            }
            const bool is_ordinate = key == fit_.ordinate;
            Eigen::MatrixXd& target = is_ordinate ? fit_.y_uncertainty : fit_.x_uncertainty;
            if (target.size() > 0) {
                object->refuse(
                    k_fit_uncertainty, key,
                    "a covariance of " + text::in_quotes(key) + " beside " + text::in_quotes("u_" + std::string{key}),
                    "an uncertainty is stated once", "remove one of the two");
                continue;
            }
            read_covariance_of(*object, key, *value, is_ordinate ? units_.back() : units_.front(), target);
        }
    }

    void read_covariance_of(const JsonObject& object, std::string_view key, const json& value, const gum::Unit& unit,
                            Eigen::MatrixXd& target) {
        const auto n = fit_.y.size();
        if (n == 0) {
            return;  // refused for having no points
        }
        if (n > static_cast<Eigen::Index>(k_most_in_matrix)) {
            object.refuse(k_too_many_quantities, key, text::count_of(n, "point"),
                          "a covariance matrix has at most " + std::to_string(k_most_in_matrix) + " points",
                          "state standard uncertainties");
            return;
        }
        Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
        if (value.is_object()) {
            const auto source = object.optional_object(key, k_file_object_keys);
            const auto name = source ? JobFiles::file_name(*source, "file", true) : std::nullopt;
            const auto file = name ? files_.open(*name) : std::nullopt;
            const auto read =
                file ? read_csv_matrix(file->bytes, static_cast<std::size_t>(n), "", *file->problems) : std::nullopt;
            if (!read) {
                return;
            }
            matrix = *read;
        } else {
            const json* rows = object.optional_array(key);
            for (Eigen::Index i = 0; rows != nullptr && i < n; ++i) {
                std::vector<double> row;
                const auto index = static_cast<std::size_t>(i);
                if (rows->size() != static_cast<std::size_t>(n) || !(*rows)[index].is_array() ||
                    (*rows)[index].size() != static_cast<std::size_t>(n)) {
                    object.refuse(k_wrong_size, key, "a matrix of another size",
                                  "the covariance has " + std::to_string(n) + " rows and columns, one for each point",
                                  "correct the matrix");
                    return;
                }
                if (!numbers((*rows)[index], child_pointer(object.pointer(key), index), row)) {
                    return;
                }
                matrix.row(i) = Eigen::Map<const Eigen::RowVectorXd>(row.data(), n);
            }
            if (rows == nullptr) {
                return;
            }
        }
        matrix = matrix.unaryExpr([&](double c) { return unit.difference_to_si(unit.difference_to_si(c)); });
        const Eigen::VectorXd u = matrix.diagonal().cwiseAbs().cwiseSqrt();
        for (Eigen::Index i = 0; i < n; ++i) {
            for (Eigen::Index j = 0; j < i; ++j) {
                if (!(std::abs(matrix(i, j) - matrix(j, i)) <= k_same_number * u(i) * u(j))) {
                    object.refuse(k_matrix_not_symmetric, key,
                                  "the elements (" + std::to_string(i + 1) + ", " + std::to_string(j + 1) +
                                      ") of the covariance of " + text::in_quotes(key) + " differ",
                                  "a covariance matrix is symmetric", "correct the matrix");
                    return;
                }
            }
        }
        const bool is_definite =
            matrix.allFinite() && u.minCoeff() > 1e-140 && u.maxCoeff() < 1e140 && matrix.diagonal().minCoeff() > 0.0 &&
            Eigen::LLT<Eigen::MatrixXd>(
                Eigen::MatrixXd(u.cwiseInverse().asDiagonal() * matrix * u.cwiseInverse().asDiagonal()))
                    .info() == Eigen::Success;
        if (!is_definite) {
            object.refuse(k_covariance_not_definite, key,
                          "the covariance of " + text::in_quotes(key) + " is not positive definite",
                          "the points of a fit are weighted by the inverse of the matrix", "correct the matrix");
            return;
        }
        target = std::move(matrix);
    }

    // ---- checks of the whole ----------------------------------------------------------------------------------------

    void check_counts() {
        const auto n = fit_.y.size();
        const auto p = static_cast<Eigen::Index>(fit_.parameters.size());
        const bool by_residuals = fit_.scale_by_residuals || fit_.y_uncertainty.size() == 0;
        const auto least = by_residuals ? p + 1 : p;
        if (n < least) {
            object_.refuse(k_fit_data, "data", text::count_of(n, "point") + " for " + text::count_of(p, "parameter"),
                           by_residuals ? "without stated uncertainties the residuals give them: there must be more "
                                          "points than parameters"
                                        : "there must be at least as many points as parameters",
                           "add points, or remove parameters");
        } else if (n > static_cast<Eigen::Index>(k_most_fit_points)) {
            object_.refuse(k_too_many_quantities, "data", text::count_of(n, "point"),
                           "a fit has at most " + std::to_string(k_most_fit_points) + " points", "state fewer points");
        }
    }

    void check_uncertainties() {
        if (fit_.x_uncertainty.size() > 0 && fit_.y_uncertainty.size() == 0) {
            object_.refuse(k_fit_uncertainty, "data",
                           text::in_quotes(fit_.regressors.front()) + " has an uncertainty, and " +
                               text::in_quotes(fit_.ordinate) + " has none",
                           "with an uncertain regressor the uncertainty of the ordinate must be stated",
                           "add " + text::in_quotes("u_" + fit_.ordinate));
        }
    }

    void check_equation() {
        std::vector<gum::InputSymbol> symbols;
        std::vector<std::size_t> parameters;
        for (const gum::BudgetFit::Parameter& parameter : fit_.parameters) {
            parameters.push_back(symbols.size());
            symbols.push_back({parameter.name, parameter.unit, std::nullopt});
        }
        for (std::size_t i = 0; i < fit_.regressors.size(); ++i) {
            symbols.push_back({fit_.regressors[i], fit_.regressor_units[i], std::nullopt});
        }
        const std::array<gum::OutputSymbol, 1> output{
            gum::OutputSymbol{fit_.ordinate, fit_.ordinate_unit, object_.where("equation")}};
        const std::array<gum::EquationText, 1> equation{fit_.equation};
        try {
            const gum::EquationSystem system = gum::EquationSystem::compile(equation, symbols, {}, output);
            for (const gum::Diagnostic& warning : system.warnings()) {
                // A curve through the origin of the Celsius scale is what the data were taken for.
                if (warning.code != "GC-MODEL-0041") {
                    problems_.warn(InputCode{warning.code, {}}, warning.where, warning.what, warning.rule,
                                   warning.action);
                }
            }
            for (const std::size_t unused : system.unused_inputs()) {
                if (unused < parameters.size()) {
                    object_.refuse(k_fit_name, "parameters",
                                   "the parameter " + text::in_quotes(symbols[unused].name) + " is not in the equation",
                                   "every parameter is determined by the data", "remove it, or correct the equation");
                }
            }
            if (system.is_affine_in(parameters)) {
                return;
            }
        } catch (const gum::DiagnosedError& error) {
            refuse_as(error, "", problems_);
            return;
        }
        for (const gum::BudgetFit::Parameter& parameter : fit_.parameters) {
            if (!parameter.start) {
                problems_.refuse(
                    k_fit_start, document_.where(child_pointer(object_.pointer("parameters"), parameter.name)),
                    "the parameter " + text::in_quotes(parameter.name) + " has no start value",
                    "an equation that is not linear in its parameters is fitted from start values", "add \"start\"");
            }
        }
    }

    const JsonObject& object_;
    std::string pointer_;
    const JsonDocument& document_;
    JobFiles& files_;
    ProblemList& problems_;
    gum::BudgetFit fit_;
    std::vector<std::string> uses_;
    std::vector<std::string> columns_;  ///< regressors, then the ordinate
    std::vector<gum::Unit> units_;      ///< of the columns
};

}  // namespace

bool is_quantity_name(const std::string& name, const std::string& where, ProblemList& problems) {
    std::optional<std::string> objection;
    if (name.size() > 256) {
        objection = "has " + std::to_string(name.size()) + " bytes";
    } else if (gum::is_reserved_name(name)) {
        objection = "is a word of the equation language";
    } else {
        objection = gum::reason_against_name(name);
    }
    if (objection) {
        problems.refuse(k_quantity_name, where, "the name " + text::in_quotes(name) + " " + *objection,
                        "a name of a quantity begins with a letter or _ and has letters, digits, _ and ' only",
                        "choose another name, and describe the quantity in \"description\"");
        return false;
    }
    return true;
}

std::optional<gum::Unit> read_unit(const JsonObject& object, std::string_view key, ProblemList& problems) {
    if (!object.has(key)) {
        return gum::Unit();
    }
    const std::optional<std::string> text = object.optional_name(key);
    if (!text) {
        return std::nullopt;
    }
    try {
        return gum::Unit::parse(*text);
    } catch (const gum::InputError& error) {
        refuse_as(error, object.where(key), problems);
        return std::nullopt;
    }
}

void refuse_as(const gum::DiagnosedError& error, const std::string& where, ProblemList& problems) {
    for (const gum::Diagnostic& diagnostic : error.diagnostics()) {
        const InputCode code{diagnostic.code, {}};
        // What the other layer calls the place, such as the text of the unit, says what is wrong there.
        problems.refuse(code, where.empty() ? diagnostic.where : where,
                        where.empty() ? diagnostic.what : diagnostic.where + ": " + diagnostic.what, diagnostic.rule,
                        diagnostic.action);
    }
}

std::optional<gum::EquationText> equation_text_of(const json& value, const std::string& where, ProblemList& problems) {
    if (value.is_discarded()) {
        return std::nullopt;
    }
    if (!value.is_string()) {
        problems.refuse(k_wrong_type, where, described(value), "must be a string", "write \"name = expression\"");
        return std::nullopt;
    }
    std::string text = value.get<std::string>();
    text.erase(0, std::min(text.find_first_not_of(' '), text.size()));
    text.erase(text.find_last_not_of(' ') + 1);
    if (const auto objection = name_objection(text, gum::ExpressionLimits{}.bytes)) {
        problems.refuse(k_equation_text, where, "the equation " + text::in_quotes(text) + " " + *objection,
                        "an equation is one line of at most 65536 bytes without hidden characters",
                        "correct the equation, or split it into several");
        return std::nullopt;
    }
    return gum::EquationText{std::move(text), where};
}

std::vector<gum::BudgetFit> read_fits(const JsonObject& root, const JsonDocument& document,
                                      const std::vector<std::string>& inputs, JobFiles& files, ProblemList& problems) {
    std::vector<gum::BudgetFit> fits;
    const json* value = root.find("fits");
    if (value == nullptr) {
        return fits;
    }
    if (!value->is_object()) {
        root.refuse(k_wrong_type, "fits", described(*value), "must be an object", "name each fit");
        return fits;
    }
    std::map<std::string, std::string> taken;
    for (const std::string& name : inputs) {
        taken.emplace(name, "an input");
    }
    const std::string pointer = root.pointer("fits");
    for (const std::string& name : keys_in_order(document, pointer)) {
        const std::string here = child_pointer(pointer, name);
        if (const auto objection = name_objection(name)) {
            problems.refuse(k_text_not_allowed, document.where(here),
                            "the name " + text::in_quotes(name) + " " + *objection,
                            "a name has 1 to 256 bytes, no spaces around it and no control or hidden characters",
                            "correct the name");
            continue;
        }
        if (!value->at(name).is_object()) {
            problems.refuse(k_wrong_type, document.where(here), described(value->at(name)), "must be an object",
                            "state equation, parameters and data");
            continue;
        }
        const JsonObject object(document, here, keys_of<FitStatement>(), problems);
        fits.push_back(FitReader(object, here, document, files, problems).read(name, taken));
    }
    return fits;
}

}  // namespace gumcert::jobs
