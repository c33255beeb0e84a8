#include "jobs/budget/budget_points.h"

#include <algorithm>
#include <array>
#include <utility>

#include "gum/expression/name.h"
#include "jobs/budget/point_file.h"
#include "jobs/budget/point_list.h"
#include "jobs/input_codes.h"
#include "text/lists.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

namespace {

using nlohmann::json;

constexpr std::size_t k_most_named = 5;

/// Where only points state an input, what stands in the job is what the first of them says.
void take_from_points(std::size_t position, BudgetJob& job) {
    for (const gum::BudgetPoint& point : job.points) {
        for (const auto& [index, input] : point.inputs) {
            if (index == position) {
                job.inputs[position] = input;
                job.inputs[position].stated = false;
                return;
            }
        }
    }
}

/// A value, or an uncertainty, that the job leaves to the points: adding it to the job would be a statement of those
/// points that nobody has made.
bool is_left_open(const gum::Diagnostic& refused) {
    return refused.code == k_no_statement.code || refused.code == k_incomplete_statement.code ||
           refused.code == k_no_uncertainty.code;
}

}  // namespace

BudgetPoints::BudgetPoints(const JsonDocument& document, BudgetInputs& inputs, JobFiles& files,
                           LaboratoryUse& laboratory, BudgetJob& job, ProblemList& problems)
    : document_(document),
      inputs_(inputs),
      files_(files),
      laboratory_(laboratory),
      job_(job),
      problems_(problems),
      columns_(document, inputs, job, problems),
      coverage_(inputs.stated().size()) {}

void BudgetPoints::set_used(const std::optional<std::set<std::string>>& names) {
    const std::vector<BudgetInputs::Stated>& inputs = inputs_.stated();
    std::vector<bool>& used = used_.emplace_back(inputs.size(), !names);
    std::vector<std::size_t> found;
    for (std::size_t i = 0; names && i < inputs.size(); ++i) {
        used[i] = names->contains(gum::canonical_name(inputs[i].name));
        if (used[i]) {
            found.push_back(i);
        }
    }
    // A specification reads the value of another input.
    while (!found.empty()) {
        const std::size_t reader = found.back();
        found.pop_back();
        for (std::size_t i = 0; i < inputs.size(); ++i) {
            const std::vector<std::size_t>& readers = inputs_.readers(i);
            if (!used[i] && std::find(readers.begin(), readers.end(), reader) != readers.end()) {
                used[i] = true;
                found.push_back(i);
            }
        }
    }
}

bool BudgetPoints::is_used(const std::string& input, std::size_t section) const {
    const auto found = inputs_.find(input);
    return found && section < used_.size() && used_[section][*found];
}

std::optional<int> BudgetPoints::decimals(const std::string& input, std::size_t point) const {
    const auto found = inputs_.find(input);
    if (!found || point >= coverage_[*found].decimals.size() || coverage_[*found].decimals[point] < 0) {
        return std::nullopt;
    }
    return coverage_[*found].decimals[point];
}

void BudgetPoints::read(const JsonObject& object, const std::optional<std::set<std::string>>& used) {
    set_used(used);
    const json* points = object.find("points");
    if (points == nullptr) {
        for (std::size_t i = 0; i < coverage_.size(); ++i) {
            coverage_[i].is_wanted_alone = coverage_[i].is_wanted_alone || used_.back()[i];
        }
        return;
    }
    if (inputs_.find(std::string{k_point_name})) {
        problems_.refuse(k_name_of_two, document_.where("/inputs/point"),
                         "an input is named \"point\" in a job with points",
                         "in a table of points this word names the point", "rename the input");
        return;
    }
    const std::size_t before = job_.points.size();
    if (points->is_array()) {
        read_point_list(*points, object.pointer("points"), document_, inputs_, job_.fits, *this, problems_);
    } else if (points->is_object()) {
        static constexpr std::array<std::string_view, 3> k_keys{"file", "list", "columns"};
        read_table(JsonObject(document_, object.pointer("points"), k_keys, problems_));
    } else {
        object.refuse(k_wrong_type, "points", described(*points), "must be an array or an object",
                      "give an array of points, or {\"file\": \"points.csv\"}");
    }
    columns_.fill();
    const std::size_t added = job_.points.size() - before;
    for (std::size_t i = 0; i < coverage_.size(); ++i) {
        if (used_.back()[i]) {
            coverage_[i].wanted += added;
            coverage_[i].is_table_refused = coverage_[i].is_table_refused || added == 0;
        }
    }
}

void BudgetPoints::read_table(const JsonObject& table) {
    columns_.read_declared(table);
    columns_.fill();
    if (!table.has("list")) {
        if (const auto name = JobFiles::file_name(table, "file", true)) {
            read_point_file(*name, files_, laboratory_, document_, inputs_, job_.fits, *this);
        }
    } else if (table.has("file")) {
        table.refuse(k_two_statements, "list", "\"file\" and \"list\" are given together",
                     "points stand in a file or in the job", "keep one of them");
    } else if (const json* list = table.optional_array("list")) {
        read_point_list(*list, table.pointer("list"), document_, inputs_, job_.fits, *this, problems_);
    }
}

// ---- one point ------------------------------------------------------------------------------------------------------

void BudgetPoints::add(const StatedPoint& stated, const std::string& where, ProblemList& problems) {
    gum::BudgetPoint point;
    point.name = name_point(stated, where, problems);
    note_coverage(stated, point.name);
    std::map<std::size_t, BudgetInputs::Evaluated> here;
    std::set<std::size_t> read_again;
    for (std::size_t i = 0; i < inputs_.stated().size(); ++i) {
        if (used_.back()[i] && !inputs_.stated()[i].is_complete) {
            read_again.insert(i);
        }
    }
    for (const auto& [input, keys] : stated.statements) {
        if (stated.refused.contains(input)) {
            continue;
        }
        if (auto evaluated = evaluated_at(input, keys)) {
            here.emplace(input, std::move(*evaluated));
            read_again.insert(inputs_.readers(input).begin(), inputs_.readers(input).end());
        }
    }
    for (const std::size_t input : read_again) {
        if (!stated.statements.contains(input) && inputs_.stated()[input].base) {
            here.emplace(input, *inputs_.stated()[input].base);
        }
    }
    const BudgetInputs::Reading reading = [&](const std::string& name) -> const gum::BudgetInput* {
        const auto found = inputs_.find(name);
        if (!found) {
            return nullptr;
        }
        if (const auto own = here.find(*found); own != here.end()) {
            return &own->second.input;
        }
        const auto& base = inputs_.stated()[*found].base;
        return base ? &base->input : nullptr;
    };
    for (auto& [input, evaluated] : here) {
        if (inputs_.complete(evaluated, reading) && BudgetInputs::check_digits(evaluated)) {
            point.inputs.emplace_back(inputs_.position(input), evaluated.input);
        }
    }
    std::sort(point.inputs.begin(), point.inputs.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    job_.points.push_back(std::move(point));
}

std::string BudgetPoints::name_point(const StatedPoint& stated, const std::string& where, ProblemList& problems) {
    std::string name = stated.name.value_or(std::to_string(job_.points.size() + 1));
    const auto [entry, is_new] = point_names_.try_emplace(name, where);
    if (!is_new) {
        problems.refuse(k_repeated_point, where,
                        "a second point " + text::in_quotes(name) + ", the first is at " + entry->second,
                        "points have different names", "rename one of the two");
    }
    return name;
}

void BudgetPoints::note_coverage(const StatedPoint& stated, const std::string& name) {
    for (const auto& [input, key] : stated.replaced) {
        ++coverage_[input].overridden[key];
    }
    for (const auto& [input, decimals] : stated.decimals) {
        coverage_[input].decimals.resize(job_.points.size() + 1, -1);
        coverage_[input].decimals.back() = decimals;
    }
    for (const auto& [input, keys] : stated.statements) {
        if (keys.has("resolution")) {
            inputs_.note_resolution(input);
        }
    }
    for (std::size_t i = 0; i < coverage_.size(); ++i) {
        if (!used_.back()[i]) {
            continue;
        }
        if (stated.statements.contains(i) || stated.refused.contains(i)) {
            ++coverage_[i].stated;
        } else if (coverage_[i].silent.size() < k_most_named) {
            coverage_[i].silent.push_back(name);
        }
    }
}

std::optional<BudgetInputs::Evaluated> BudgetPoints::evaluated_at(std::size_t input, const StatementKeys& keys) {
    const BudgetInputs::Stated& stated = inputs_.stated()[input];
    const std::size_t position = inputs_.position(input);
    // The correlation from simultaneous observations belongs to the observations of the job.
    const bool is_simultaneous =
        std::any_of(job_.simultaneous.begin(), job_.simultaneous.end(), [&](const gum::SimultaneousInputs& set) {
            return std::find(set.inputs.begin(), set.inputs.end(), position) != set.inputs.end();
        });
    if (is_simultaneous) {
        keys.refuse(k_not_simultaneous, text::in_quotes(stated.name) + " was observed together with other inputs",
                    "its observations, and hence its value, are those of the job", "remove it from the point");
        return std::nullopt;
    }
    std::optional<BudgetInputs::Evaluated> evaluated = inputs_.evaluate(stated, keys);
    if (!evaluated) {
        return std::nullopt;
    }
    const bool is_correlated =
        evaluated->input.constant &&
        std::any_of(job_.correlations.begin(), job_.correlations.end(), [&](const gum::InputCorrelation& pair) {
            return pair.first == position || pair.second == position;
        });
    if (is_correlated) {
        keys.refuse(k_correlation_of_constant,
                    text::in_quotes(stated.name) + " is a constant at this point, and correlated",
                    "a quantity without uncertainty has no correlation", "state its uncertainty");
        return std::nullopt;
    }
    // A point measures its own quantity, unless the job says that it is one for all of them.
    evaluated->input.common = evaluated->is_stated_common;
    return evaluated;
}

// ---- all points -----------------------------------------------------------------------------------------------------

void BudgetPoints::finish() {
    std::vector<std::string> unused;
    for (std::size_t i = 0; i < coverage_.size(); ++i) {
        const BudgetInputs::Stated& input = inputs_.stated()[i];
        const Coverage& points = coverage_[i];
        const bool everywhere = points.wanted > 0 && points.stated == points.wanted && !points.is_wanted_alone;
        if (!everywhere && input.pending) {
            report_open(i);
        }
        if (!input.base || !input.is_complete) {
            take_from_points(inputs_.position(i), job_);
        }
        if (!everywhere) {
            continue;
        }
        for (const auto& [key, count] : points.overridden) {
            if (count == points.wanted && input.keys->has(key) &&
                (key == "value" || key == "observations" || key == "groups" || key == "samples" || key == "limits")) {
                unused.push_back(text::in_quotes(input.name + "." + std::string{key}));
            }
        }
    }
    if (!unused.empty()) {
        problems_.note(
            k_warn_unused_value, document_.where("/inputs"),
            text::listed(unused, k_most_named) + " of the inputs: every point of the table states another one",
            "an input may be left to the points: nothing needs to stand in its place", "remove them");
    }
}

/// What is wrong with the statement of the job counts, for not all points replace it.
void BudgetPoints::report_open(std::size_t input) {
    const ProblemList& pending = *inputs_.stated()[input].pending;
    const Coverage& points = coverage_[input];
    if (!points.is_wanted_alone && points.is_table_refused) {
        // What the job leaves open may stand in the table that could not be read.
        problems_.take(pending, [](const gum::Diagnostic& one) { return !is_left_open(one); });
    } else if (points.is_wanted_alone || (points.wanted == 0 && !job_.points.empty())) {
        problems_.take(pending);
    } else {
        refuse_unstated(input);
    }
}

void BudgetPoints::refuse_unstated(std::size_t input) {
    const BudgetInputs::Stated& stated = inputs_.stated()[input];
    const Coverage& points = coverage_[input];
    const std::vector<gum::Diagnostic> refused = stated.pending->refused();
    if (refused.empty() || !std::ranges::all_of(refused, is_left_open) || (points.stated == 0 && points.wanted > 0)) {
        problems_.take(*stated.pending);
        return;
    }
    if (points.wanted == 0) {
        return;
    }
    std::string names;
    for (const std::string& name : points.silent) {
        names += (names.empty() ? "" : ", ") + text::in_quotes(name);
    }
    const std::size_t silent = points.wanted - points.stated;
    if (silent > points.silent.size()) {
        names += " and " + std::to_string(silent - points.silent.size()) + " more";
    }
    if (refused.front().code == k_no_statement.code) {
        stated.keys->refuse(k_no_statement,
                            "nothing is stated of it, and the points " + names + " do not state it either",
                            "an input has a statement of its own, or every point of the table has one",
                            "state it at these points, or in the inputs");
        return;
    }
    const InputCode& code = refused.front().code == k_no_uncertainty.code ? k_no_uncertainty : k_incomplete_statement;
    stated.keys->refuse(code, refused.front().what + ", and the points " + names + " do not state it either",
                        refused.front().rule, "state it at these points; in the inputs it holds for all that do not");
}

}  // namespace gumcert::jobs
