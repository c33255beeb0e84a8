#include "jobs/rotary_table/reference_budget.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "gum/quantity/unit.h"
#include "jobs/budget/budget_results.h"
#include "jobs/input_text.h"
#include "jobs/problem_list.h"
#include "text/counts.h"
#include "text/numbers.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

namespace {

constexpr std::string_view k_reading = "reading";
// Statements of an uncertainty about a value that another value can take the place of. A series of observations, limits
// or samples is a value by itself.
constexpr std::array<std::string_view, 11> k_replaceable{
    "u",        "U, k",       "U, p",          "half_width",    "resolution",   "mpe",
    "constant", "relative_u", "relative_U, k", "relative_U, p", "specification"};

/// Another source with one file changed.
class ChangedFile final : public FileSource {
public:
    ChangedFile(const FileSource& source, std::string name, std::string bytes)
        : source_(source), name_(std::move(name)), bytes_(std::move(bytes)) {}
    [[nodiscard]] std::string read(const std::string& name) const override {
        return name == name_ ? bytes_ : source_.read(name);
    }
    [[nodiscard]] bool has_laboratory() const override { return source_.has_laboratory(); }

private:
    const FileSource& source_;
    std::string name_;
    std::string bytes_;
};

/// Position after the brace that opens a JSON document which was read before.
std::size_t after_first_brace(std::string_view bytes) {
    std::size_t at = 0;
    while (at < bytes.size() && bytes[at] != '{') {
        at = bytes[at] == '/' ? std::min(bytes.find('\n', at), bytes.size()) : at + 1;
    }
    return std::min(at + 1, bytes.size());
}

void check_output(const BudgetJob& budget, ProblemList& problems) {
    const auto outputs = budget_results(budget);
    if (outputs.size() == 1 && outputs.front().second.dimension() == gum::Unit::parse("m").dimension()) {
        return;
    }
    std::string found;
    for (const auto& [name, unit] : outputs) {
        found += (found.empty() ? "" : ", ") + name + " [" + unit.text() + "]";
    }
    problems.refuse(k_reference_budget_output, text::visible(problems.file()) + "#/outputs",
                    (outputs.size() == 1 ? "the result is " : "the results are ") + found,
                    "the budget of a reference value has one output, a length",
                    "state one output with a unit of length, such as um");
}

void check_reading(const BudgetJob& budget, ProblemList& problems) {
    const std::string rule = "the mean reading at each point takes the place of the value of the input \"reading\"";
    const auto reading = std::find_if(budget.inputs.begin(), budget.inputs.end(),
                                      [](const gum::BudgetInput& input) { return input.name == k_reading; });
    if (reading == budget.inputs.end()) {
        problems.refuse(k_reference_budget_reading, text::visible(problems.file()) + "#/inputs",
                        "no input is named \"reading\"", rule,
                        R"(add "reading": {"value": 0, "unit": "um", "constant": true} and use it in the model)");
        return;
    }
    if (reading->unit.dimension() != gum::Unit::parse("m").dimension()) {
        problems.refuse(k_reference_budget_reading, reading->where,
                        "the unit of \"reading\" is " + text::in_quotes(reading->unit.text()),
                        "readings of the reference method are displacements", "state a unit of length, such as um");
        return;
    }
    const std::string& statement = reading->components.front().statement;
    if (reading->components.size() > 1 || !reading->components.front().name.empty()) {
        problems.refuse(k_reference_budget_reading, reading->where, "\"reading\" is a sum of components", rule,
                        "keep the value in \"reading\", and make inputs of their own of the components");
    } else if (std::find(k_replaceable.begin(), k_replaceable.end(), statement) == k_replaceable.end()) {
        problems.refuse(k_reference_budget_reading, reading->where,
                        "\"reading\" is stated by " + text::in_quotes(statement), rule,
                        "state its value with \"u\", or with \"constant\": true, and make an input of its own of what "
                        "was observed");
    }
}

/// The points of the table as the job of the budget would state them.
std::string points_of(const BudgetJob& budget, std::span<const ReferencePoint> points,
                      std::span<const double> angles_deg) {
    static constexpr std::array<char, 3> k_directions{'x', 'y', 'z'};
    const auto reading = std::find_if(budget.inputs.begin(), budget.inputs.end(),
                                      [](const gum::BudgetInput& input) { return input.name == k_reading; });
    nlohmann::json table = nlohmann::json::array();
    for (const ReferencePoint& point : points) {
        table.push_back({{"point", std::string(1, k_directions[point.direction]) + " " +
                                       text::shortest_plain(angles_deg[point.angle]) + "°"},
                         {k_reading, reading->unit.from_si(point.mean)}});
    }
    return "\"points\": " + table.dump() + ",";
}

}  // namespace

std::vector<ReferencePoint> reference_points(std::span<const engine::ReferenceReading> readings) {
    std::map<std::pair<std::size_t, std::size_t>, std::vector<double>> values;
    for (const engine::ReferenceReading& reading : readings) {
        values[{reading.direction, reading.angle}].push_back(reading.reading);
    }
    std::vector<ReferencePoint> points;
    for (const auto& [at, of_point] : values) {
        ReferencePoint point{.direction = at.first, .angle = at.second, .runs = of_point.size()};
        for (const double value : of_point) {
            point.mean += value / static_cast<double>(of_point.size());
        }
        points.push_back(point);
    }
    return points;
}

BudgetJob read_reference_budget(const FileSource& source, const std::string& file,
                                std::span<const ReferencePoint> points, std::span<const double> angles_deg) {
    BudgetJob budget = read_undivided_budget_job(source, file);
    ProblemList problems(file);
    if (!budget.points.empty()) {
        problems.refuse(k_reference_budget_points, text::visible(file) + "#/points",
                        text::count_of(budget.points.size(), "point"),
                        "the points of the budget of a reference value are those of the readings", "remove \"points\"");
    }
    check_output(budget, problems);
    check_reading(budget, problems);
    if (problems.refusals() > 0) {
        throw gum::InputError(problems.refused());
    }
    if (points.empty()) {
        return budget;
    }
    // The reader itself builds the table, so that all that depends on a reading (a percentage of it) follows it.
    std::string bytes = source.read(file);
    bytes.insert(after_first_brace(bytes), points_of(budget, points, angles_deg));
    return read_budget_job(ChangedFile(source, file, std::move(bytes)), file);
}

}  // namespace gumcert::jobs
