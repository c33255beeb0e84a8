#include "self_test/case_run.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string_view>

#include "evaluation/audit_evaluation.h"
#include "evaluation/evaluate_job.h"
#include "evaluation/read_file.h"
#include "gum/quantity/diagnostic.h"
#include "jobs/file_source.h"
#include "text/numbers.h"
#include "text/split.h"

namespace gumcert::self_test {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using nlohmann::ordered_json;

constexpr double k_rounding_of_tolerance = 1e-9;

/// Why a value has nothing to be compared with.
[[noreturn]] void not_found(const std::string& where, const std::string& what) {
    throw gum::InputError(gum::Diagnostic{.code = "GC-SELF-0001",
                                          .where = where,
                                          .what = what,
                                          .rule = "a path leads from the name of a job, or data, to a value",
                                          .action = "correct the path in the case"});
}

/// A copy of an object with changes: objects key by key, everything else as a whole.
ordered_json merged(const ordered_json& base, const ordered_json& changes) {
    if (!base.is_object() || !changes.is_object()) {
        return changes;
    }
    ordered_json result = base;
    for (const auto& [key, value] : changes.items()) {
        result[key] = base.contains(key) ? merged(base[key], value) : value;
    }
    return result;
}

bool is_number(const std::string& step) {
    return !step.empty() && std::all_of(step.begin(), step.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// Null stands for infinity, as in degrees of freedom.
double number_of(const json& value, const std::string& path) {
    if (value.is_null()) {
        return std::numeric_limits<double>::infinity();
    }
    if (!value.is_number()) {
        not_found(path, "no number stands there");
    }
    return value.get<double>();
}

CaseValue as_value(const json& value, const std::string& path) {
    if (value.is_boolean()) {
        return value.get<bool>();
    }
    if (value.is_string()) {
        return value.get<std::string>();
    }
    if (value.is_array()) {
        std::vector<double> row;
        for (const json& item : value) {
            row.push_back(number_of(item, path));
        }
        return row;
    }
    return number_of(value, path);
}

/// The records of the jobs of one case; a job is evaluated when its record is first asked for.
class CaseRecords {
public:
    CaseRecords(const ReferenceCase& reference, const fs::path& templates)
        : reference_(reference), templates_(templates) {}

    [[nodiscard]] CaseValue value(const std::string& formula) {
        return value_of_formula(formula, [this](const std::string& path) { return as_value(at(path), path); });
    }

private:
    const ReferenceCase& reference_;
    const fs::path& templates_;
    std::map<std::string, json> records_;
    std::map<std::string, gum::Diagnostic> refused_;
    std::set<std::string> begun_;

    const json& at(const std::string& path) {
        const std::vector<std::string> steps = text::split(path, '/');
        const json* place = steps.front() == "data" ? &reference_.data : &record(steps.front());
        for (std::size_t i = 1; i < steps.size(); ++i) {
            place = &next(*place, steps[i], path);
        }
        return *place;
    }

    static const json& next(const json& place, const std::string& step, const std::string& path) {
        if (place.is_object()) {
            const auto found = place.find(step);
            if (found == place.end()) {
                not_found(path, "there is no " + step);
            }
            return *found;
        }
        if (!place.is_array()) {
            not_found(path, "nothing stands below " + step);
        }
        if (is_number(step)) {
            std::size_t row = place.size();
            std::from_chars(step.data(), step.data() + step.size(), row);
            if (row >= place.size()) {
                not_found(path, "there is no row " + step);
            }
            return place[row];
        }
        const json* only = nullptr;
        for (const json& row : place) {
            if (has_all(row, step)) {
                if (only != nullptr) {
                    not_found(path, "several rows have " + step);
                }
                only = &row;
            }
        }
        if (only == nullptr) {
            not_found(path, "no row has " + step);
        }
        return *only;
    }

    /// Whether a row holds "key=value,key=value".
    static bool has_all(const json& row, const std::string& wanted) {
        const std::vector<std::string> parts = text::split(wanted, ',');
        return row.is_object() && std::all_of(parts.begin(), parts.end(), [&row](const std::string& part) {
                   const std::size_t sign = std::min(part.find('='), part.size());
                   const auto found = row.find(part.substr(0, sign));
                   return sign < part.size() && found != row.end() && found->is_string() &&
                          found->get_ref<const std::string&>() == std::string_view(part).substr(sign + 1);
               });
    }

    const json& record(const std::string& name) {
        if (const auto refused = refused_.find(name); refused != refused_.end()) {
            throw gum::InputError(refused->second);
        }
        auto found = records_.find(name);
        if (found == records_.end()) {
            if (!reference_.jobs.contains(name)) {
                not_found(name, "there is no job of this name");
            }
            if (!begun_.insert(name).second) {
                not_found(name, "the job needs its own record");
            }
            try {
                found = records_.emplace(name, evaluated(name)).first;
            } catch (const gum::DiagnosedError& error) {
                gum::Diagnostic why = error.diagnostics().front();
                why.where = "job " + name + ": " + why.where;
                refused_.emplace(name, why);
                throw gum::InputError(why);
            }
        }
        return found->second;
    }

    json evaluated(const std::string& name) {
        ordered_json job{{"schema", "gumcert/job/1"}, {"kind", "budget"}, {"title", reference_.title}};
        job.update(filled_in(stated_job(name, 0)));
        const jobs::MemoryFileSource files({{"job.json", job.dump()}});
        const evaluation::Evaluation evaluation =
            evaluation::evaluate_job(files, "job.json", evaluation::CovarianceFile::none, 1, templates_);
        json made = json::parse(reports::to_canonical_json(evaluation.record));
        const bool negative = evaluation.negative || evaluation.blocked ||
                              evaluation::is_refuted_by_audit(evaluation) ||
                              (evaluation.record.certificate && evaluation.record.certificate->blocked);
        made["exit_code"] = negative ? 1 : 0;
        return made;
    }

    /// A job as the case states it, with what it takes over from another one ("like").
    ordered_json stated_job(const std::string& name, std::size_t depth) const {
        const auto found = reference_.jobs.find(name);
        if (found == reference_.jobs.end() || !found->is_object() || depth > reference_.jobs.size()) {
            not_found(name, "there is no job of this name, or it is like itself");
        }
        ordered_json job = *found;
        const auto like = job.find("like");
        if (like == job.end()) {
            return job;
        }
        if (!like->is_string()) {
            not_found(name, "like is no name of a job");
        }
        const ordered_json base = stated_job(like->get<std::string>(), depth + 1);
        job.erase("like");
        return merged(base, job);
    }

    /// A part of a job with its formulas replaced by their values.
    ordered_json filled_in(const ordered_json& part) {
        if (part.is_structured()) {
            ordered_json result = part;
            for (ordered_json& item : result) {
                item = filled_in(item);
            }
            return result;
        }
        if (!part.is_string() || part.get_ref<const std::string&>().find('{') == std::string::npos) {
            return part;
        }
        const std::string& formula = part.get_ref<const std::string&>();
        if (formula.front() == '{' && formula.find('}') == formula.size() - 1) {
            return ordered_json(
                at(formula.substr(1, formula.size() - 2)));  // whatever stands there, lists of lists among them
        }
        return std::visit([](const auto& found) { return ordered_json(found); }, value(formula));
    }
};

/// None where both are equal by themselves, or are texts.
std::optional<double> tolerance_of(const ExpectedValue& expected, CaseRecords& records) {
    if (!expected.tolerance_formula.empty()) {
        const CaseValue value = records.value(expected.tolerance_formula);
        if (const double* const number = std::get_if<double>(&value)) {
            return *number;
        }
        not_found(expected.tolerance_formula, "no number stands there");
    }
    if (expected.tolerance) {
        return expected.tolerance;
    }
    const double wanted = std::get<double>(expected.wanted);
    return expected.relative_tolerance ? *expected.relative_tolerance * std::abs(wanted) : expected.half_unit();
}

void compare(ComparedValue& value, const CaseValue& found, CaseRecords& records) {
    const ExpectedValue& expected = value.expected;
    value.computed = found;
    value.was_found = true;
    const double* const number = std::get_if<double>(&found);
    const double* const wanted = std::get_if<double>(&expected.wanted);
    if (number == nullptr || wanted == nullptr) {
        const std::string* const text = std::get_if<std::string>(&found);
        value.agrees = text != nullptr ? *text == expected.text && !std::holds_alternative<bool>(expected.wanted)
                                       : found == expected.wanted;
        value.digits_reached = value.agrees ? expected.digits() : 0;
    } else if (*number == *wanted) {  // infinities among them
        value.agrees = true;
        value.digits_reached = expected.digits();
    } else {
        value.tolerance = tolerance_of(expected, records);
        value.digits_reached = std::isfinite(*wanted) ? digits_reached(*wanted, expected.digits(), *number) : 0;
        const double allowed =
            *value.tolerance * (1.0 + k_rounding_of_tolerance) + 4e-16 * std::abs(*wanted);  // both are rounded
        value.agrees = std::abs(*number - *wanted) <= allowed;
    }
    if (!value.agrees) {
        value.because = value_text(found, 15) + ", expected " + expected.text +
                        (value.tolerance ? " ± " + text::significant(*value.tolerance, 3) : "");
    }
}

ComparedValue compared(const ExpectedValue& expected, CaseRecords& records) {
    ComparedValue value{.expected = expected};
    try {
        for (std::size_t i = 0; i < expected.found.size(); ++i) {
            ComparedValue here{.expected = expected};
            compare(here, records.value(expected.found[i]), records);
            if (i == 0 || !here.agrees) {
                value = here;
            }
            if (!here.agrees) {
                value.because += " (" + expected.found[i] + ")";
                break;
            }
        }
    } catch (const gum::DiagnosedError& error) {
        const gum::Diagnostic& why = error.diagnostics().front();
        value.agrees = false;
        value.because = why.where + ": " + why.what + " [" + why.code + "]";
    }
    return value;
}

}  // namespace

std::size_t CaseOutcome::agreed() const {
    return static_cast<std::size_t>(
        std::count_if(values.begin(), values.end(), [](const ComparedValue& value) { return value.agrees; }));
}

bool CaseOutcome::passes() const {
    return refused.empty() && !values.empty() && agreed() == values.size();
}

CaseOutcome run_case(const ReferenceCase& reference, const fs::path& templates) {
    CaseOutcome outcome{.reference = reference};
    CaseRecords records(reference, templates);
    for (const ExpectedValue& expected : reference.expected) {
        if (!expected.found.empty()) {
            outcome.values.push_back(compared(expected, records));
        }
    }
    if (outcome.values.empty()) {
        outcome.refused = "no value of the case is compared";
    }
    return outcome;
}

CaseOutcome run_case_file(const fs::path& file, const fs::path& templates) {
    const std::string text = evaluation::read_file(file);
    try {
        return run_case(reference_case_from_json(text, file.stem().string()), templates);
    } catch (const gum::InputError& error) {
        const gum::Diagnostic& why = error.diagnostics().front();
        CaseOutcome outcome;
        outcome.reference.id = file.stem().string();
        outcome.refused = why.what + " [" + why.code + "]";
        return outcome;
    }
}

std::string value_text(const CaseValue& value, int digits) {
    if (const double* const number = std::get_if<double>(&value)) {
        return digits >= 17 ? text::shortest(*number) : text::significant(*number, digits);
    }
    if (const bool* const answer = std::get_if<bool>(&value)) {
        return *answer ? "yes" : "no";
    }
    if (const std::string* const text = std::get_if<std::string>(&value)) {
        return *text;
    }
    return "a row of " + std::to_string(std::get<std::vector<double>>(value).size()) + " numbers";
}

}  // namespace gumcert::self_test
