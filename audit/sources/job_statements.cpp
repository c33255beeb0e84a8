#include "audit/sources/job_statements.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

#include "gum/quantity/diagnostic.h"
#include "workbook/read_csv.h"

namespace gumcert::audit {
namespace {

using nlohmann::json;

/// Ways to say what is known of a quantity: where a point uses one of them, that of the job holds no longer. Other keys
/// (k, nu, distribution) go on to hold unless the point has them too.
constexpr std::array<std::string_view, 11> k_ways_to_state = {
    "u",   "U",          "relative_u",   "relative_U", "half_width", "limits",
    "mpe", "resolution", "observations", "samples",    "components"};

bool states_uncertainty(const json& statement) {
    return std::any_of(k_ways_to_state.begin(), k_ways_to_state.end(),
                       [&statement](std::string_view key) { return statement.contains(key); });
}

bool has_readings(const json& statement) {
    return statement.contains("observations") || statement.contains("groups");
}

/// Readings stand beside components, or beside a resolution, and each is stated where it changes.
bool stands_beside(std::string_view key, const json& own) {
    const bool states_others = own.contains("components") || own.contains("resolution");
    return ((key == "components" || key == "resolution") && has_readings(own) && !states_others) ||
           (key == "observations" && states_others && !has_readings(own));
}

json without(json statement, std::initializer_list<std::string_view> keys) {
    for (const std::string_view key : keys) {
        statement.erase(std::string(key));
    }
    return statement;
}

/// "3" of a reading `V.3`.
bool is_count(std::string_view text) {
    return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

std::set<std::string> texts_of(const json& array) {
    std::set<std::string> texts;
    for (const json& text : array.is_array() ? array : json::array()) {
        if (text.is_string()) {
            texts.insert(text.get<std::string>());
        }
    }
    return texts;
}

/// The inputs of each statement of a job on correlations: pairs with their coefficients, a covariance matrix, observations that were
/// taken together, and samples of one file.
std::vector<std::set<std::string>> inputs_together(const json& job) {
    std::vector<std::set<std::string>> together;
    for (const char* const key : {"correlations", "simultaneous"}) {
        if (const auto groups = job.find(key); groups != job.end() && groups->is_array()) {
            std::transform(groups->begin(), groups->end(), std::back_inserter(together), texts_of);
        }
    }
    if (const auto covariance = job.find("covariance"); covariance != job.end() && covariance->is_object()) {
        together.push_back(texts_of(covariance->value("inputs", json::array())));
    }
    std::map<std::string, std::set<std::string>> of_file;
    const json inputs = job.value("inputs", json::object());
    for (const auto& [name, statement] : inputs.items()) {
        const json samples = statement.is_object() ? statement.value("samples", json()) : json();
        const json file = samples.is_object() ? samples.value("file", json()) : samples;
        if (file.is_string()) {
            of_file[file.get<std::string>()].insert(name);
        }
    }
    for (auto& [file, names] : of_file) {
        together.push_back(std::move(names));
    }
    return together;
}

}  // namespace

JobStatements::JobStatements(const reports::EvaluationRecord& record) {
    // The job of a record is canonical; another job among its files is as a person wrote it, with comments.
    const json job = json::parse(record.job_json, nullptr, false, true);
    if (!job.is_object()) {
        return;
    }
    if (const auto inputs = job.find("inputs"); inputs != job.end() && inputs->is_object()) {
        inputs_ = *inputs;
    }
    together_ = inputs_together(job);
    read_points(job, record);
    for (const reports::SectionSummary& section : record.sections) {  // in the order in which their points are numbered
        const auto sections = job.find("sections");
        if (sections != job.end() && sections->is_object() && sections->contains(section.name)) {
            read_points(sections->at(section.name), record);
        }
        first_ += static_cast<std::size_t>(std::max<std::int64_t>(section.points, 0));
    }
}

void JobStatements::read_points(const json& part, const reports::EvaluationRecord& record) {
    const auto points = part.is_object() ? part.find("points") : part.end();
    if (!part.is_object() || points == part.end()) {
        return;
    }
    if (points->is_array()) {
        read_array(*points);
    } else if (points->is_object() && points->contains("list") && points->at("list").is_array()) {
        read_array(points->at("list"));
    } else if (points->is_object() && points->contains("file") && points->at("file").is_string()) {
        for (const reports::InputFile& file : record.job_files) {
            const std::optional<std::string> bytes =
                file.name == points->at("file").get_ref<const std::string&>() ? reports::bytes_of(file) : std::nullopt;
            if (bytes) {
                read_table(*bytes);
            }
        }
    }
}

void JobStatements::read_array(const json& points) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!points[i].is_object()) {
            continue;
        }
        json stated = json::object();
        std::string name = std::to_string(first_ + i + 1);
        for (const auto& [key, value] : points[i].items()) {
            if (key == "point") {
                name = value.is_string() ? value.get<std::string>() : value.dump();
            } else {
                stated[key] = value.is_object() ? value : json{{"value", value}};
            }
        }
        by_point_[name] = std::move(stated);
    }
}

void JobStatements::read_table(const std::string& bytes) {
    workbook::Workbook table;
    try {
        table = workbook::read_csv(bytes, "points", "points");
    } catch (const gum::DiagnosedError&) {
        return;  // a dialect that the reader of jobs alone knows: the statements of the job stay
    }
    if (table.sheets.empty()) {
        return;
    }
    std::map<std::uint32_t, std::string> heads;
    std::map<std::uint32_t, std::pair<std::string, json>> rows;
    for (const workbook::Cell& cell : table.sheets.front().cells) {
        const workbook::CellValue& value = cell.value;
        if (cell.address.row == 1) {
            heads[cell.address.column] = value.text;
            continue;
        }
        const auto head = heads.find(cell.address.column);
        if (head == heads.end() || value.kind == workbook::CellKind::blank) {
            continue;
        }
        auto& [name, stated] = rows.try_emplace(cell.address.row, "", json::object()).first->second;
        if (head->second == "point") {
            name = value.text;
            continue;
        }
        const std::size_t dot = head->second.find('.');
        const std::string input = head->second.substr(0, dot);
        const std::string key = dot == std::string::npos ? "value" : head->second.substr(dot + 1);
        const json content = value.kind == workbook::CellKind::number ? json(value.number) : json(value.text);
        if (is_count(key)) {
            stated[input]["observations"].push_back(content);
        } else {
            stated[input][key] = content;
        }
    }
    for (auto& [row, point] : rows) {
        const std::string name = point.first.empty() ? std::to_string(first_ + row - 1) : point.first;
        by_point_[name] = std::move(point.second);
    }
}

json JobStatements::of(const std::string& input, const std::string& point) const {
    const auto common = inputs_.is_object() ? inputs_.find(input) : inputs_.end();
    json statement = common != inputs_.end() && common->is_object() ? *common : json();
    const auto at = by_point_.find(point);
    if (point.empty() || at == by_point_.end() || !at->second.contains(input)) {
        return statement;
    }
    const json& own = at->second.at(input);
    if (statement.is_null()) {
        return own;
    }
    if (states_uncertainty(own)) {
        for (const std::string_view key : k_ways_to_state) {
            if (!stands_beside(key, own)) {
                statement.erase(std::string(key));
            }
        }
    }
    statement.update(own);
    return statement;
}

json JobStatements::of_part(const std::string& input, const std::string& point, const reports::BudgetRow& part) const {
    const json statement = of(input, point);
    if (!statement.is_object() || !part.standard.empty()) {
        return {};
    }
    if (const auto components = statement.find("components"); components != statement.end() && components->is_array()) {
        for (const json& component : *components) {
            const auto name = component.is_object() ? component.find("name") : component.end();
            if (component.is_object() && name != component.end() && *name == part.input) {
                return component;
            }
        }
    }
    if (part.input == "readings" && has_readings(statement)) {
        return without(statement, {"components", "resolution", "distribution", "nu", "reliability"});
    }
    if (part.input == "resolution" && has_readings(statement) && statement.contains("resolution")) {
        return without(statement, {"observations", "groups", "pooled", "type"});
    }
    return {};
}

json JobStatements::of_whole(const std::string& input, const std::string& point) const {
    json statement = of(input, point);
    const auto components = statement.is_object() ? statement.find("components") : statement.end();
    if (!statement.is_object() || components == statement.end() || !components->is_array()) {
        return statement;
    }
    return components->size() == 1 && !has_readings(statement) ? components->front() : json();
}

}  // namespace gumcert::audit
