#include <algorithm>
#include <optional>
#include <set>
#include <sstream>
#include <string>

#include "certificate/agreed_rule.h"
#include "certificate/capability.h"
#include "gum/conformity/conformity.h"
#include "gum/quantity/unit.h"
#include "jobs/certificate/certificate_archive.h"
#include "jobs/input_text.h"
#include "text/numbers.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

namespace {

void demand_some(const std::vector<std::string>& list, const std::string& key, const CertificatePlace& place) {
    if (list.empty()) {
        place.below("/" + key).refuse(k_certificate_empty_list, "an empty list",
                                      "the entry names the results that it is for",
                                      "name the results, such as \"EXA\" or \"E*\", or remove the entry");
    }
}

void demand_order(std::optional<double> low, std::optional<double> high, const std::string& low_key,
                  const std::string& unit, const CertificatePlace& place) {
    if (low && high && *low > *high) {
        place.below("/" + low_key)
            .refuse(k_certificate_limits, text::shortest_plain(*low) + " " + unit,
                    "must not be above the other end of " + text::shortest_plain(*high) + " " + unit,
                    "exchange the two, or correct the sign");
    }
}

/// Names that must differ among the entries of a list.
class Names {
public:
    explicit Names(std::string what) : what_(std::move(what)) {}
    void add(const std::string& name, const CertificatePlace& place) {
        if (!name.empty() && !names_.insert(name).second) {
            place.refuse(k_certificate_repeated, what_ + " " + text::in_quotes(name) + " for the second time",
                         what_ + " is used once", "choose another, or remove the repetition");
        }
    }

private:
    std::string what_;
    std::set<std::string> names_;
};

void check_rule(const certificate::AgreedSpecification& s, const CertificatePlace& place) {
    const std::optional<gum::DecisionRule> rule = gum::decision_rule_from_id(s.rule.id);
    if (!rule) {
        return;
    }
    // Limits of points lie on both sides of a value; those in columns may miss one side, which no rule depends on.
    const gum::ToleranceLimits limits{.lower = s.limits ? std::optional(-1.0) : s.lower,
                                      .upper = s.limits ? std::optional(1.0) : s.upper};
    for (const std::string& sentence :
         gum::check_decision_rule(*rule, certificate::stated_parameters(s.rule), limits)) {
        place.below("/rule").refuse(k_certificate_rule_incomplete, sentence,
                                    "a rule is applied with the parameters that it has, and with no others",
                                    "correct the decision rule as it was agreed with the customer");
    }
}

}  // namespace

void check_entry(const certificate::Capability& capability, const CertificatePlace& place) {
    for (const certificate::CapabilityProblem& problem : certificate::check_capability(capability)) {
        place.below(problem.key).refuse(k_certificate_capability, problem.what, problem.rule, problem.action);
    }
}

void check_entry(const certificate::ScopeEntry::Range& range, const CertificatePlace& place) {
    demand_order(range.low, range.high, "low", range.argument.unit, place);
}

void check_entry(const certificate::ScopeEntry& entry, const CertificatePlace& place) {
    demand_some(entry.results, "results", place);
    for (std::size_t i = 0; i < entry.results.size(); ++i) {
        if (entry.results[i].find_first_not_of('*') == std::string::npos) {
            place.below("/results")
                .child(i)
                .refuse(k_certificate_any_result,
                        text::in_quotes(entry.results[i]) + " covers every result, whatever is measured",
                        "a line of the scope is for one measurand", "name the results, such as \"EXA\" or \"E*\"");
        }
    }
    Names arguments("the argument");
    for (std::size_t i = 0; i < entry.ranges.size(); ++i) {
        arguments.add(entry.ranges[i].argument.name, place.below("/ranges").child(i).below("/argument/name"));
    }
}

void check_entry(const certificate::StandardUsed& standard, const CertificatePlace& place) {
    if (standard.U && standard.unit.empty()) {
        place.below("/U").refuse(k_certificate_missing_key, "an uncertainty without unit",
                                 "a number that is not of dimension one has a unit",
                                 "add \"unit\" (\"1\" for a quantity of dimension one)");
    }
}

void check_entry(const certificate::Condition& condition, const CertificatePlace& place) {
    demand_order(condition.minimum, condition.maximum, "minimum", condition.unit, place);
    demand_order(condition.lower_limit, condition.upper_limit, "lower_limit", condition.unit, place);
}

void check_entry(const certificate::Method& method, const CertificatePlace& place) {
    if (method.no_deviations && !method.deviations.empty()) {
        place.below("/no_deviations")
            .refuse(k_certificate_contradiction, "true beside a list of deviations",
                    "either there are deviations from the method or there are none",
                    "remove \"no_deviations\", or the list");
    }
}

void check_entry(const certificate::PointLimits::Accuracy& accuracy, const CertificatePlace& place) {
    const auto needs = [&](bool stated, bool other_stated, const char* key, const char* other) {
        if (stated && !other_stated) {
            place.refuse(k_certificate_missing_key, text::in_quotes(key) + " without " + text::in_quotes(other),
                         "a part of an accuracy has all its numbers", "add " + text::in_quotes(other));
        }
    };
    needs(accuracy.percent_of_range.has_value(), accuracy.full_scale.has_value(), "percent_of_range", "full_scale");
    needs(accuracy.full_scale.has_value(), accuracy.percent_of_range.has_value(), "full_scale", "percent_of_range");
    needs(accuracy.digits.has_value(), accuracy.digit.has_value(), "digits", "digit");
    needs(accuracy.digit.has_value(), accuracy.digits.has_value(), "digit", "digits");
    if (!accuracy.percent_of_reading && !accuracy.percent_of_range && !accuracy.digits && !accuracy.constant) {
        place.refuse(k_certificate_no_limit, "an accuracy without a part",
                     "an accuracy is a sum of percent_of_reading, percent_of_range, digits and constant",
                     "state at least one of them");
    }
}

constexpr std::string_view k_unused_argument = "the expression does not use the argument";

void check_entry(const certificate::PointLimits& limits, const CertificatePlace& place) {
    struct Part {
        const char* key;
        bool stated, belongs, needed;
    };
    const bool accuracy = limits.by == "accuracy";
    const bool steps = limits.by == "steps";
    const bool expression = limits.by == "expression";
    const bool themselves = expression && (!limits.limit_low.empty() || !limits.limit_high.empty());
    const bool of_reading = std::any_of(limits.accuracy.begin(), limits.accuracy.end(),
                                        [](const auto& entry) { return entry.percent_of_reading.has_value(); });
    for (const Part& part :
         {Part{"accuracy", !limits.accuracy.empty(), accuracy, accuracy},
          Part{"of", !limits.of.empty(), accuracy, accuracy && of_reading},
          Part{"steps", !limits.steps.empty(), steps, steps},
          Part{"arguments", !limits.arguments.empty(), steps || expression, steps || expression},
          Part{"expression", !limits.expression.empty(), expression && !themselves, expression && !themselves},
          Part{"limit_low", !limits.limit_low.empty(), expression, false},
          Part{"limit_high", !limits.limit_high.empty(), expression, false},
          Part{"about", !limits.about.empty(), !themselves, false}}) {
        if (part.stated && !part.belongs) {
            place.below("/" + std::string(part.key))
                .refuse(
                    k_certificate_contradiction,
                    text::in_quotes(part.key) + " beside " +
                        (themselves ? "\"limit_low\" or \"limit_high\"" : "limits by " + text::in_quotes(limits.by)),
                    "limits are stated in one way", "remove it, or correct \"by\"");
        } else if (!part.stated && part.needed) {
            place.refuse(k_certificate_missing_key, text::in_quotes(part.key) + " is missing",
                         "limits by " + text::in_quotes(limits.by) + " need it", "add " + text::in_quotes(part.key));
        }
    }
    if (steps && limits.arguments.size() > 1) {
        place.below("/arguments")
            .refuse(k_certificate_contradiction, std::to_string(limits.arguments.size()) + " arguments",
                    "steps have one argument", "keep the one that the steps are of");
    }
    for (std::size_t i = 1; i < limits.steps.size(); ++i) {
        demand_order(limits.steps[i - 1].up_to, limits.steps[i].up_to, "steps", "", place);
    }
    const std::vector<std::pair<const char*, const std::string*>> expressions{
        {"/expression", &limits.expression}, {"/limit_low", &limits.limit_low}, {"/limit_high", &limits.limit_high}};
    for (const auto& [key, text] : expressions) {
        if (!expression || limits.arguments.empty() || text->empty()) {
            continue;
        }
        certificate::Capability mpe;
        mpe.form = "function";
        mpe.unit = "1";
        mpe.arguments = limits.arguments;
        mpe.expression = *text;
        for (const certificate::CapabilityProblem& problem : certificate::check_capability(mpe)) {
            // A limit may be the same for all points; that both are is told below.
            if (text == &limits.expression || !problem.what.starts_with(k_unused_argument)) {
                place.below(problem.key == "/expression" ? key : problem.key)
                    .refuse(k_certificate_capability, problem.what, problem.rule, problem.action);
            }
        }
    }
    if (themselves && !limits.arguments.empty()) {
        certificate::Capability both;
        both.form = "function";
        both.unit = "1";
        both.arguments = limits.arguments;
        both.expression = "0";
        for (const std::string* const limit : {&limits.limit_low, &limits.limit_high}) {
            both.expression += limit->empty() ? "" : " + (" + *limit + ")";
        }
        for (const certificate::CapabilityProblem& problem : certificate::check_capability(both)) {
            if (problem.what.starts_with(k_unused_argument)) {
                place.below("/arguments").refuse(k_certificate_capability, problem.what, problem.rule, problem.action);
            }
        }
    }
}

void check_entry(const certificate::AgreedSpecification& specification, const CertificatePlace& place) {
    demand_some(specification.results, "results", place);
    const std::optional<double> lower = specification.lower;
    const std::optional<double> upper = specification.upper;
    if (specification.limits) {
        if (lower || upper) {
            place.below(lower ? "/lower" : "/upper")
                .refuse(k_certificate_contradiction, "a limit for all points beside limits of points",
                        "the limits of a specification are stated in one way", "remove it, or \"limits\"");
        }
        const gum::Unit unit = gum::Unit::parse(specification.unit);
        for (std::size_t i = 0; i < specification.limits->accuracy.size(); ++i) {
            const std::string& stated = specification.limits->accuracy[i].unit;
            if (!stated.empty() && !(gum::Unit::parse(stated).dimension() == unit.dimension())) {
                place.below("/limits/accuracy")
                    .child(i)
                    .below("/unit")
                    .refuse(k_certificate_unit,
                            "the unit " + text::in_quotes(stated) + " beside " + text::in_quotes(specification.unit) +
                                " of the specification",
                            "an accuracy and its limits are of one kind of quantity", "correct the unit");
            }
        }
        check_rule(specification, place);
        return;
    }
    if (!lower && !upper) {
        place.refuse(k_certificate_no_limit, "a specification without a limit",
                     "conformity is decided against a lower limit, an upper limit or both",
                     "add \"lower\" or \"upper\", or \"limits\" where they differ from point to point");
        return;
    }
    if (lower && upper && *lower >= *upper) {
        place.below("/lower").refuse(
            k_certificate_limits, text::shortest_plain(*lower) + " " + specification.unit,
            "must be below the upper limit of " + text::shortest_plain(*upper) + " " + specification.unit,
            "exchange the two, or correct the sign");
        return;
    }
    check_rule(specification, place);
}

void check_entry(const certificate::ExternalResults& external, const CertificatePlace& place) {
    demand_some(external.results, "results", place);
}

/// A word of a sentence that begins with a digit and is no part of the name of a document: "1", "99.9", not "JCGM
/// 100:2008" or "DIN 1319". "" where there is none.
std::string number_of_its_own(const std::string& text) {
    const auto is_capital = [](char c) { return (c >= 'A' && c <= 'Z') || c == '/' || c == '-'; };
    std::istringstream words(text);
    std::string before;
    for (std::string word; words >> word; before = word) {
        const std::size_t first = word.find_first_not_of("(\"'+-.,<>=~");
        const bool digit = first != std::string::npos && word[first] >= '0' && word[first] <= '9';
        const bool of_document = word.find(':') != std::string::npos ||
                                 (before.size() > 1 && std::all_of(before.begin(), before.end(), is_capital));
        if (digit && !of_document) {
            return word;
        }
    }
    return {};
}

void check_entry(const certificate::Profile& profile, const CertificatePlace& place) {
    const auto check = [&](const std::string& text, const CertificatePlace& at) {
        for (std::size_t open = text.find('{'); open != std::string::npos; open = text.find('{', open + 1)) {
            const std::size_t close = text.find('}', open);
            const std::string name = text.substr(open, close == std::string::npos ? close : close - open + 1);
            if (name != "{k}" && name != "{coverage}") {
                at.refuse(k_certificate_placeholder, "the placeholder " + text::in_quotes(name),
                          "the sentence on uncertainty may use {k} and {coverage}", "use one of these, or none");
                return;
            }
        }
        if (text.empty()) {
            return;
        }
        for (const char* needed : {"{k}", "{coverage}"}) {
            if (text.find(needed) == std::string::npos) {
                at.refuse(k_certificate_placeholder, "a sentence without " + std::string(needed),
                          "the sentence on uncertainty says k and the coverage probability of the result",
                          "add {k} and {coverage}, or leave the sentence of the program");
                return;
            }
        }
        if (const std::string number = number_of_its_own(text); !number.empty()) {
            at.refuse(k_certificate_placeholder, "the number " + text::in_quotes(number),
                      "the sentence on uncertainty states the numbers of the result only, as {k} and {coverage}",
                      "take the number out; a document is written as \"GUM:2008\" or \"EA-4/02\"");
        }
    };
    const CertificatePlace sentence = place.below("/uncertainty_sentence");
    check(profile.uncertainty_sentence.plain, sentence);
    for (const auto& [language, text] : profile.uncertainty_sentence.by_language) {
        check(text, sentence.child(language));
    }
}

void check_lists(const certificate::CertificateData& data, const CertificatePlace& place) {
    Names languages("the language");
    for (std::size_t i = 0; i < data.languages.size(); ++i) {
        languages.add(data.languages[i], place.below("/languages").child(i));
    }
    if (data.languages.empty()) {
        place.below("/languages")
            .refuse(k_certificate_empty_list, "an empty list", "a certificate is in one language at least",
                    "name the languages, the binding one first, or leave the key out");
    }
    Names specifications("the identification");
    for (std::size_t i = 0; i < data.specifications.size(); ++i) {
        specifications.add(data.specifications[i].id, place.below("/specifications").child(i).below("/id"));
    }
    Names parameters("the parameter");
    for (std::size_t i = 0; i < data.parameters.size(); ++i) {
        parameters.add(data.parameters[i].name, place.below("/parameters").child(i).below("/name"));
    }
    Names scope("the identification");
    for (std::size_t i = 0; data.accreditation && i < data.accreditation->scope.size(); ++i) {
        scope.add(data.accreditation->scope[i].id, place.below("/accreditation/scope").child(i).below("/id"));
    }
}

}  // namespace gumcert::jobs
