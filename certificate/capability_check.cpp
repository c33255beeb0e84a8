#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "certificate/capability.h"
#include "certificate/capability_equation.h"
#include "gum/argument_check.h"
#include "gum/expression/name.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/unit.h"
#include "text/numbers.h"

namespace gumcert::certificate {
namespace {

constexpr double k_about_95_percent = 0.95;
constexpr double k_tolerance_of_95_percent = 0.01;  // 95.45 % is the same statement

bool is_open_interval(const std::string& text) {
    for (const char* sign : {"<", ">", "≤", "≥"}) {
        if (text.find(sign) != std::string::npos) {
            return true;
        }
    }
    return false;
}

// A scope is read once and decides about many certificates: what can be read in two ways is refused here, all of it at
// once, and not where a value happens to fall between two points. Form first, for every other check follows from it;
// the expression last, for it can be compiled only with arguments that are in order.
class Check {
public:
    explicit Check(const Capability& capability) : c_(capability) {}

    std::vector<CapabilityProblem> run();

private:
    void say(std::string key, std::string what, std::string rule, std::string action) {
        problems_.push_back({std::move(key), std::move(what), std::move(rule), std::move(action)});
    }
    void unit(const std::string& key, const std::string& text);
    void arguments(std::size_t least, std::size_t most);
    void U(const std::string& key, double value);
    void rising(const std::string& key, double before, double value);
    void lookup();
    void of_other_forms();
    void value();
    void points(std::size_t least, std::size_t most);
    void matrix();
    void function();

    const Capability& c_;
    std::vector<CapabilityProblem> problems_;
};

void Check::unit(const std::string& key, const std::string& text) {
    try {
        (void)gum::Unit::parse(text);
    } catch (const gum::InputError& error) {
        const gum::Diagnostic& d = error.diagnostics().front();
        say(key, d.what, d.rule, d.action);
    }
}

void Check::U(const std::string& key, double value) {
    if (!(std::isfinite(value) && value > 0.0)) {
        say(key, "U is " + text::shortest(value), "a capability is a finite uncertainty greater than 0",
            "State the smallest uncertainty of the scope here.");
    }
}

void Check::rising(const std::string& key, double before, double value) {
    // Strictly: between two points at one place nothing could be interpolated.
    if (!(std::isfinite(value) && value > before)) {
        say(key, text::shortest(value) + " after " + text::shortest(before), "points rise, so that each stands once",
            "Put the points in order, each once.");
    }
}

void Check::arguments(std::size_t least, std::size_t most) {
    if (c_.arguments.size() < least || c_.arguments.size() > most) {
        const std::string wanted = least == most ? std::to_string(least) : std::to_string(least) + " or more";
        say("/arguments", std::to_string(c_.arguments.size()) + " arguments",
            "a capability of the form \"" + c_.form + "\" has " + wanted,
            c_.arguments.size() > most ? "Remove the arguments that it does not depend on."
                                       : "State what it depends on, with the unit.");
    }
    std::set<std::string> names;
    for (std::size_t i = 0; i < c_.arguments.size(); ++i) {
        const std::string key = "/arguments/" + std::to_string(i);
        const CapabilityArgument& argument = c_.arguments[i];
        unit(key + "/unit", argument.unit);
        if (const auto reason = gum::reason_against_name(argument.name)) {
            say(key + "/name", "the name \"" + argument.name + "\" " + *reason,
                "an argument has a name as a quantity of an equation has", "Choose a short name, for instance L.");
        } else if (!names.insert(gum::canonical_name(argument.name)).second) {
            say(key + "/name", "the name " + argument.name + " a second time", "each argument has a name of its own",
                "Rename one of them.");
        }
    }
}

void Check::lookup() {
    // ILAC-P14:09/2020, section 4: a capability leaves no doubt between its points. Nothing is interpolated silently.
    const bool must = c_.form == "table" || c_.form == "matrix";
    if (must && c_.lookup != "linear" && c_.lookup != "next_worse") {
        say("/lookup", c_.lookup.empty() ? "no rule between the points" : "the rule \"" + c_.lookup + "\"",
            "the scope says what holds between its points: linear or next_worse", "State the rule of the scope.");
    }
    if (!must && !c_.lookup.empty() && !(c_.form == "range" && c_.lookup == "linear")) {
        say("/lookup", "the rule \"" + c_.lookup + "\"",
            c_.form == "range" ? "a range is linear between its ends" : "only tables and matrices are looked up",
            "Remove it, or state a table.");
    }
}

void Check::of_other_forms() {
    // A capability that is stated twice has two meanings, of which only one was accredited.
    const auto refuse = [&](bool stated, bool belongs, const char* key) {
        if (stated && !belongs) {
            say(key, "stated for a capability of the form \"" + c_.form + "\"",
                "a capability is stated once, in one form", "Remove it, or correct the form.");
        }
    };
    refuse(c_.U != 0.0, c_.form == "value", "/U");
    refuse(c_.percent_of_value.has_value(), c_.form == "value", "/percent_of_value");
    refuse(c_.ppm_of_value.has_value(), c_.form == "value", "/ppm_of_value");
    refuse(!c_.expression.empty(), c_.form == "function", "/expression");
    refuse(!c_.points.empty(), c_.form == "range" || c_.form == "table", "/points");
    refuse(!c_.rows.empty(), c_.form == "matrix", "/rows");
    refuse(!c_.columns.empty(), c_.form == "matrix", "/columns");
    refuse(!c_.matrix.empty(), c_.form == "matrix", "/matrix");
}

void Check::value() {
    const bool has_share = c_.percent_of_value || c_.ppm_of_value;
    arguments(has_share ? 1 : 0, has_share ? 1 : 0);
    if (!has_share || c_.U != 0.0) {
        U("/U", c_.U);
    }
    if (!has_share) {
        return;
    }
    if (c_.percent_of_value && c_.ppm_of_value) {
        say("/ppm_of_value", "a share in % and one in ppm", "a share of the value is stated once",
            "Keep one of the two.");
    }
    const double share = c_.ppm_of_value ? *c_.ppm_of_value : *c_.percent_of_value;
    if (!(std::isfinite(share) && share > 0.0)) {
        say(c_.ppm_of_value ? "/ppm_of_value" : "/percent_of_value", "a share of " + text::shortest(share),
            "a capability is a finite uncertainty greater than 0", "State the share of the scope.");
    }
    if (!problems_.empty()) {
        return;  // units and arguments that are in order
    }
    const gum::Unit of = gum::Unit::parse(c_.arguments[0].unit);
    if (!(of.dimension() == gum::Unit::parse(c_.unit).dimension()) || of.is_celsius_temperature() ||
        of.dimension() == gum::Unit::parse("dB").dimension()) {
        say("/arguments/0/unit",
            "a share of a value in \"" + c_.arguments[0].unit + "\" for a capability in \"" + c_.unit + "\"",
            "U and the value of which it has a share are of one kind, and neither a Celsius temperature nor a level",
            "Correct one of the units, or state a function.");
    }
}

void Check::points(std::size_t least, std::size_t most) {
    if (c_.points.size() < least || c_.points.size() > most) {
        say("/points", std::to_string(c_.points.size()) + " points",
            least == most ? "a range has two ends" : "a table has two points or more",
            "State each point with the value of the argument and U.");
    }
    for (std::size_t i = 0; i < c_.points.size(); ++i) {
        const std::string key = "/points/" + std::to_string(i);
        if (!std::isfinite(c_.points[i].at)) {
            say(key + "/at", text::shortest(c_.points[i].at), "a capability has a finite range", "State the end.");
        } else if (i > 0) {
            rising(key + "/at", c_.points[i - 1].at, c_.points[i].at);
        }
        U(key + "/U", c_.points[i].U);
    }
}

void Check::matrix() {
    const auto axis = [&](const std::string& key, const std::vector<double>& values) {
        if (values.size() < 2) {
            say(key, std::to_string(values.size()) + " values", "an argument of a matrix has two values or more",
                "State a table where there is one row or one column.");
        }
        for (std::size_t i = 0; i < values.size(); ++i) {
            const std::string at = key + "/" + std::to_string(i);
            if (!std::isfinite(values[i])) {
                say(at, text::shortest(values[i]), "a capability has a finite range", "State the end.");
            } else if (i > 0) {
                rising(at, values[i - 1], values[i]);
            }
        }
    };
    axis("/rows", c_.rows);
    axis("/columns", c_.columns);
    const bool fits = c_.matrix.size() == c_.rows.size() &&
                      std::all_of(c_.matrix.begin(), c_.matrix.end(),
                                  [&](const std::vector<double>& row) { return row.size() == c_.columns.size(); });
    if (!fits) {
        say("/matrix",
            "a matrix that is not of " + std::to_string(c_.rows.size()) + " rows and " +
                std::to_string(c_.columns.size()) + " columns",
            "each row has a U for each column", "Complete the matrix.");
        return;
    }
    for (std::size_t i = 0; i < c_.rows.size(); ++i) {
        for (std::size_t j = 0; j < c_.columns.size(); ++j) {
            U("/matrix/" + std::to_string(i) + "/" + std::to_string(j), c_.matrix[i][j]);
        }
    }
}

void Check::function() {
    if (c_.expression.find_first_not_of(" \t\r\n") == std::string::npos) {
        say("/expression", "no expression", "a function is stated as an expression of its arguments",
            "State it, for instance \"0.5 + 0.7*L\" or \"Q[0.5, 0.7*L]\".");
        return;
    }
    // "< 2" names no smallest uncertainty: any U would satisfy it.
    if (is_open_interval(c_.expression)) {
        say("/expression", "an open interval: \"" + c_.expression + "\"",
            "a capability is one number for each value of its arguments (ILAC-P14:09/2020)",
            "State the expression of U without a comparison.");
        return;
    }
    std::string problem;
    const std::string text = expanded_capability_expression(c_.expression, problem);
    if (!problem.empty()) {
        say("/expression", problem, "Q[a, b*L] means sqrt(a^2 + (b*L)^2)", "Correct the brackets.");
        return;
    }
    if (!problems_.empty()) {
        return;  // the equation needs arguments that are in order
    }
    try {
        const gum::EquationSystem equation = compile_capability(c_, text);
        for (const std::size_t unused : equation.unused_inputs()) {
            say("/expression", "the expression does not use the argument " + c_.arguments[unused].name,
                "a capability depends on the arguments that it states", "Use it, or remove it from the arguments.");
        }
    } catch (const gum::InputError& error) {
        for (const gum::Diagnostic& d : error.diagnostics()) {
            say("/expression", d.what, d.rule, d.action);
        }
    }
}

std::vector<CapabilityProblem> Check::run() {
    if (c_.form != "value" && c_.form != "range" && c_.form != "function" && c_.form != "table" &&
        c_.form != "matrix") {
        say("/form", "the form \"" + c_.form + "\"", "a capability is a value, range, function, table or matrix",
            is_open_interval(c_.form) ? "State the uncertainty itself: an open interval is not a capability."
                                      : "State one of these.");
        return std::move(problems_);
    }
    unit("/unit", c_.unit);
    if (!(std::abs(c_.coverage_probability - k_about_95_percent) <= k_tolerance_of_95_percent)) {
        say("/coverage_probability", "a coverage probability of " + text::shortest(c_.coverage_probability),
            "a capability is stated with a coverage probability of about 95 % (ILAC-P14:09/2020)",
            "State the capability as the scope does, with 0.95, 0.9545 or without this key.");
    }
    lookup();
    of_other_forms();
    if (c_.form == "value") {
        value();
    } else if (c_.form == "range") {
        arguments(1, 1);
        points(2, 2);
    } else if (c_.form == "table") {
        arguments(1, 1);
        points(2, c_.points.max_size());
    } else if (c_.form == "matrix") {
        arguments(2, 2);
        matrix();
    } else {
        // A function of nothing is a value.
        arguments(1, c_.arguments.max_size());
        function();
    }
    return std::move(problems_);
}

}  // namespace

std::vector<CapabilityProblem> check_capability(const Capability& capability) {
    return Check(capability).run();
}

}  // namespace gumcert::certificate
