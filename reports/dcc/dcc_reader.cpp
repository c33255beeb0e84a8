#include "reports/dcc/dcc_reader.h"

#include "encoding/sha2.h"
#include "reports/printable_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <set>
#include <span>
#include <utility>

#include "gum/coverage.h"
#include "reports/dcc/d_si_unit.h"
#include "reports/dcc/dcc_element.h"
#include "reports/dcc/document_limits.h"
#include "reports/view/certificate_view.h"
#include "text/plus_sign.h"
#include "text/small_letters.h"

namespace gumcert::reports {

namespace {

constexpr std::size_t k_longest_name = 40;  // of one part of a name of the job language

/// All numbers of one D-SI element, one a row.
struct Form {
    std::vector<ImportedNumber> numbers;
    bool list = false;
    [[nodiscard]] bool has_uncertainty() const {
        return std::any_of(numbers.begin(), numbers.end(), [](const ImportedNumber& n) { return n.kind != "none"; });
    }
};

/// Where a quantity stands.
struct Context {
    std::string role = "result";
    std::string result, result_en;  ///< name of what it is part of, as it stands and for the job language
    std::size_t table = 0;
    /// That the next element around it refers to: one for all rows, or one a row. Null: none.
    std::shared_ptr<const std::vector<std::size_t>> items;
    std::optional<bool> before_adjustment;
};

bool is_name_character(char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
}

/// Letters, digits and single `_`; "" where nothing of the text can be used.
std::string as_name(std::string_view text) {
    std::string name;
    for (const char letter : text) {
        const char c = text::small_letter(letter);
        if (is_name_character(c)) {
            name += c;
        } else if (!name.empty() && name.back() != '_') {
            name += '_';
        }
    }
    name = name.substr(0, k_longest_name);
    while (!name.empty() && name.back() == '_') {
        name.pop_back();
    }
    if (!name.empty() && name.front() >= '0' && name.front() <= '9') {
        name.insert(0, "q_");
    }
    return name;
}

/// A symbol as a name: its capital letters stay. "" for one that does not begin with a letter.
std::string name_of_label(std::string_view label) {
    std::string name;
    for (const char c : label) {
        const bool capital = c >= 'A' && c <= 'Z';
        if (name.empty() && !capital && !(c >= 'a' && c <= 'z')) {
            return "";
        }
        if (capital || is_name_character(c)) {
            name += c;
        } else if (name.back() != '_') {
            name += '_';
        }
    }
    name = name.substr(0, k_longest_name);
    while (!name.empty() && name.back() == '_') {
        name.pop_back();
    }
    return name;
}

/// "basic_measuredValue" → "measured_value"
std::string name_of_ref_type(const std::string& ref_type) {
    const std::string first = ref_type.substr(0, ref_type.find(' '));
    const std::size_t prefix = first.find('_');
    std::string words;
    for (const char c : prefix == std::string::npos ? first : first.substr(prefix + 1)) {
        const bool capital = c >= 'A' && c <= 'Z';
        words += capital && !words.empty() && is_name_character(words.back()) ? "_" : "";
        words += c;
    }
    return as_name(words);
}

/// Entry of a list for a row: one entry stands for all rows. Nothing where the lengths do not fit.
std::optional<std::string> entry(const std::vector<std::string>& words, std::size_t row, std::size_t rows) {
    if (words.size() == 1) {
        return words.front();
    }
    return words.size() == rows ? std::optional(words[row]) : std::nullopt;
}

bool is_not_a_number(const std::string& text) {
    return text == "NaN" || text == "nan" || text == "INF" || text == "-INF" || text == "inf" || text == "-inf";
}

bool holds_number(const std::string& text) {
    return !text.empty() && !is_not_a_number(text);
}

std::optional<double> number_of(const std::string& text) {
    const std::string_view digits = text::without_plus(text);
    double value = 0.0;
    const auto [end, failure] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    const bool whole = failure == std::errc() && end == digits.data() + digits.size() && std::isfinite(value);
    return whole ? std::optional(value) : std::nullopt;
}

void set_kind(ImportedNumber& number) {
    if (!number.low.empty() && !number.high.empty()) {
        number.kind = "coverage_interval";
    } else if (!number.U.empty()) {
        number.kind = "expanded";
    } else if (!number.u.empty()) {
        number.kind = "standard";
    }
}

/// "" where a coverage factor is one that the coverage probability can have: from that of an arcsine distribution, the
/// least of those in use, to that of a t-distribution with one degree of freedom, the largest.
std::string contradiction_of_k_and_p(const ImportedNumber& number) {
    const std::optional<double> k = number_of(number.k);
    const std::optional<double> p = number_of(number.p);
    if (!p) {
        return k && *k < 1.0 ? "its coverage factor is " + number.k + ", below 1, and no coverage probability is stated"
                             : "";
    }
    if (!(*p > 0.0 && *p < 1.0)) {
        return k ? "its coverage probability is " + number.p : "";  // alone it is refused where it is used
    }
    if (!k || !(*k > 0.0)) {
        return "";
    }
    constexpr double k_printed = 0.01;  // of k: as it is rounded on certificates
    // An arcsine distribution of half-width a has u = a/√2, and the fraction p of it lies within a·sin(πp/2): so
    // k = √2 sin(πp/2). At smaller p the factor of the normal distribution is less; the limit is the lesser of the two.
    const double least = std::numbers::sqrt2 * std::sin(0.5 * std::numbers::pi * *p);
    const double normal = gum::coverage_factor(*p, std::numeric_limits<double>::infinity());
    const double most = gum::coverage_factor(*p, 1.0);
    if (*k >= std::min(least, normal) - k_printed && *k <= most + k_printed) {
        return "";
    }
    return "its coverage factor " + number.k + " does not belong to its coverage probability " + number.p;
}

/// The standard uncertainty that a statement comes to; none where it cannot be told.
std::optional<double> standard_uncertainty_of(const ImportedNumber& number) {
    if (const std::optional<double> u = number_of(number.u)) {
        return u;
    }
    const std::optional<double> U = number_of(number.U);
    const std::optional<double> k = number_of(number.k);
    return U && k && *k > 0.0 ? std::optional(*U / *k) : std::nullopt;
}

std::string statement_of(const ImportedNumber& number) {
    return number.kind == "standard"            ? "u = " + number.u
           : number.kind == "coverage_interval" ? number.low + " to " + number.high
                                                : "U = " + number.U + (number.k.empty() ? "" : " with k = " + number.k);
}

/// Adds one statement of uncertainty to those that a number has. Two that contradict each other are both worth nothing.
void add_statement(const ImportedNumber& stated, ImportedNumber& number) {
    constexpr double k_rounding = 0.05;  // of U: what two digits lose at most
    if (number.kind != "none" && stated.kind != "none" && number.objection.empty()) {
        const std::optional<double> first = standard_uncertainty_of(number);
        const std::optional<double> second = standard_uncertainty_of(stated);
        const std::optional<double> first_U = number_of(number.U);
        const std::optional<double> second_U = number_of(stated.U);
        const auto differ = [&](const std::optional<double>& a, const std::optional<double>& b) {
            return a && b && std::abs(*a - *b) > k_rounding * std::max(std::abs(*a), std::abs(*b));
        };
        const bool comparable = first && second;
        // Standard uncertainties are compared where both can be told: two U may differ and say the same, with two
        // factors.
        if (differ(first, second) || (!comparable && differ(first_U, second_U))) {
            number.objection =
                "its uncertainty is stated twice, as " + statement_of(number) + " and as " + statement_of(stated);
        }
    }
    for (std::string ImportedNumber::*text :
         {&ImportedNumber::u, &ImportedNumber::U, &ImportedNumber::k, &ImportedNumber::p, &ImportedNumber::low,
          &ImportedNumber::high, &ImportedNumber::distribution, &ImportedNumber::objection}) {
        if ((number.*text).empty()) {
            number.*text = stated.*text;
        }
    }
    set_kind(number);
}

class Reader {
public:
    Reader(std::string file, ImportedCertificate& out) : file_(std::move(file)), out_(out) {
        for (std::size_t i = 0; i < out.items.size(); ++i) {
            item_of_id_.emplace(out.items[i].id, i);
        }
    }

    void walk(const XmlElement& element, Context context);

private:
    void remark(const char* code, const XmlElement& at, const std::string& what, const std::string& rule,
                const std::string& action) {
        out_.remarks.push_back({.code = code,
                                .where = place_of(at, file_),
                                .what = what,
                                .rule = rule,
                                .action = action,
                                .severity = gum::Severity::warning});
    }

    /// \throws gum::InputError  GC-DCC-0004
    void require_few_numbers(std::size_t count, const XmlElement& at) const {
        if (count > k_most_numbers) {
            throw gum::InputError(gum::Diagnostic{.code = "GC-DCC-0004",
                                                  .where = place_of(at, file_),
                                                  .what = "more than 100000 numbers",
                                                  .rule = "certificates are read up to a hundred thousand numbers",
                                                  .action = "ask the issuer for the tables as files of their own"});
        }
    }
    void add_quantity(const XmlElement& quantity, const Context& context);
    void add_position(const XmlElement& coordinate, const Context& context);
    void add_rows(const XmlElement& quantity, const Context& context, const Form& main,
                  const std::vector<const Form*>& others, const std::string& note);
    [[nodiscard]] static std::string base_name(const XmlElement& quantity, const Context& context, const Form& form);
    [[nodiscard]] std::vector<std::size_t> items_of(const XmlElement& element) const;
    [[nodiscard]] std::string free_name(const std::string& base, const std::string& result, std::size_t rows);

    std::vector<Form> forms_of(const XmlElement& element);
    Form real(const XmlElement& element);
    Form real_list(const XmlElement& element);
    Form xml_list_of_reals(const XmlElement& element);
    Form complex_numbers(const XmlElement& element);
    Form nested_list(const XmlElement& element);
    void uncertainty_from(const XmlElement& stated, std::span<ImportedNumber> numbers);
    void uncertainty_in(const XmlElement& holder, std::span<ImportedNumber> numbers);
    void wrong_length(const XmlElement& at, std::size_t entries, std::size_t values, const std::string& what);
    bool place_list(const XmlElement& list, std::span<ImportedNumber> numbers, std::string ImportedNumber::*into);
    void unit(const std::string& d_si, const XmlElement& at, ImportedNumber& number);

    std::string file_;
    ImportedCertificate& out_;
    std::set<std::string, std::less<>> names_;
    std::map<std::pair<std::string, std::size_t>, std::size_t> next_version_;  ///< of words for so many rows
    std::set<std::string, std::less<>> unknown_units_;                         // each one is remarked once
    std::size_t tables_ = 0;
    std::map<std::string, std::size_t, std::less<>> item_of_id_;  ///< in ImportedCertificate::items
};

void Reader::unit(const std::string& d_si, const XmlElement& at, ImportedNumber& number) {
    number.d_si_unit = d_si;
    const std::optional<std::string> known = unit_from_d_si(d_si);
    number.unit = known.value_or("");
    if (!known && unknown_units_.insert(d_si).second) {
        remark("GC-DCC-0021", at, "unit \"" + printable(d_si) + "\"",
               "units are converted from D-SI where both sides know them", "state the unit in the job yourself");
    }
}

/// `stated` is an element such as si:expandedMU or si:coverageIntervalXMLList; what it says goes to every number.
void Reader::uncertainty_from(const XmlElement& stated, std::span<ImportedNumber> numbers) {
    bool whole = true;  // U without its k, or one end of an interval, is no uncertainty
    const auto place = [&](std::initializer_list<const char*> names, std::string ImportedNumber::*into) {
        for (const char* name : names) {
            for (const std::string& spelling : {"si:" + std::string(name), "si:" + std::string(name) + "XMLList"}) {
                if (const XmlElement* const child = stated.child(spelling); child != nullptr) {
                    const bool fits = place_list(*child, numbers, into);
                    // Probability and distribution describe an uncertainty, and it can be used without them. Where the
                    // numbers themselves have the wrong length, nobody knows which value they belong to: taking the
                    // first ones could give a value too small a U.
                    whole = whole && (fits || into == &ImportedNumber::p || into == &ImportedNumber::distribution);
                }
            }
        }
    };
    place({"valueStandardMU", "standardUnc"}, &ImportedNumber::u);
    place({"valueExpandedMU", "uncertainty"}, &ImportedNumber::U);
    place({"coverageFactor"}, &ImportedNumber::k);
    place({"coverageProbability"}, &ImportedNumber::p);
    place({"intervalMin"}, &ImportedNumber::low);
    place({"intervalMax"}, &ImportedNumber::high);
    place({"distribution"}, &ImportedNumber::distribution);
    for (ImportedNumber& number : numbers) {
        if (!whole) {
            for (std::string* text : {&number.u, &number.U, &number.k, &number.p, &number.low, &number.high}) {
                text->clear();
            }
        }
        for (const std::string* text : {&number.u, &number.U, &number.low, &number.high}) {
            // A row of a list may have no value, and no uncertainty then; beside a value NaN is no statement.
            // An interval of a distribution without variance has no standard uncertainty.
            const bool without_variance = text == &number.u && holds_number(number.low) && holds_number(number.high);
            if (is_not_a_number(*text) && !is_not_a_number(number.value) && !without_variance &&
                number.objection.empty()) {
                number.objection = "its uncertainty is stated as " + *text;
            }
        }
        for (std::string* text : {&number.u, &number.U, &number.k, &number.p, &number.low, &number.high}) {
            if (is_not_a_number(*text)) {
                text->clear();  // how D-SI says that there is none
            }
        }
        set_kind(number);
        if (number.objection.empty()) {
            number.objection = contradiction_of_k_and_p(number);
        }
    }
}

void Reader::wrong_length(const XmlElement& at, std::size_t entries, std::size_t values, const std::string& what) {
    remark("GC-DCC-0022", at, std::to_string(entries) + " entries beside " + std::to_string(values) + " values",
           "one entry stands for all values, else there is one for each", "look at the certificate; " + what);
}

/// One entry for all numbers, or one for each.
/// \return whether the lengths fit
bool Reader::place_list(const XmlElement& list, std::span<ImportedNumber> numbers, std::string ImportedNumber::*into) {
    const std::vector<std::string> words = xml_list(list.text);
    if (words.size() != 1 && words.size() != numbers.size()) {
        wrong_length(list, words.size(), numbers.size(),
                     into == &ImportedNumber::p || into == &ImportedNumber::distribution
                         ? "these entries were not imported"
                         : "the uncertainty was not imported");
        return false;
    }
    for (std::size_t row = 0; row < numbers.size(); ++row) {
        numbers[row].*into = words[words.size() == 1 ? 0 : row];
    }
    return true;
}

/// The uncertainty that stands in a D-SI element, in any of the spellings of D-SI 1.3 to 2.2.1.
void Reader::uncertainty_in(const XmlElement& holder, std::span<ImportedNumber> numbers) {
    static constexpr std::array k_groups{"si:measurementUncertaintyUnivariate",
                                         "si:measurementUncertaintyUnivaraite",  // as D-SI 2.2 spells it in realList
                                         "si:measurementUncertaintyUnivariateXMLList",
                                         "si:listMeasurementUncertaintyUnivariate", "si:listUnivariateUnc"};
    static constexpr std::array k_statements{"si:standardMU",         "si:expandedMU",
                                             "si:coverageIntervalMU", "si:expandedUnc",
                                             "si:coverageInterval",   "si:standardMUXMLList",
                                             "si:expandedMUXMLList",  "si:coverageIntervalMUXMLList",
                                             "si:expandedUncXMLList", "si:coverageIntervalXMLList"};
    for (const XmlElement& child : holder.children) {
        if (std::find(k_groups.begin(), k_groups.end(), child.name) != k_groups.end()) {
            uncertainty_in(child, numbers);
        } else if (std::find(k_statements.begin(), k_statements.end(), child.name) != k_statements.end()) {
            std::vector<ImportedNumber> stated(numbers.size());
            for (std::size_t row = 0; row < numbers.size(); ++row) {
                stated[row].value = numbers[row].value;
            }
            uncertainty_from(child, stated);
            for (std::size_t row = 0; row < numbers.size(); ++row) {
                add_statement(stated[row], numbers[row]);
            }
        }
    }
}

/// si:real and si:constant.
Form Reader::real(const XmlElement& element) {
    ImportedNumber number;
    number.value = element.child_text("si:value");
    number.label = element.child_text("si:label");
    unit(element.child_text("si:unit"), element, number);
    uncertainty_in(element, {&number, 1});
    if (element.name == "si:constant") {
        uncertainty_from(element, {&number, 1});
        if (number.kind == "expanded") {  // si:uncertainty of a constant is a standard uncertainty (D-SI 2.0 to 2.2)
            number.kind = "standard";
            number.u = std::exchange(number.U, "");
        }
    }
    return {.numbers = {number}, .list = false};
}

/// si:realList: elements si:real with what is common to them beside.
Form Reader::real_list(const XmlElement& element) {
    Form form{.numbers = {}, .list = true};
    for (const XmlElement* one : element.children_named("si:real")) {
        ImportedNumber number;
        number.value = one->child_text("si:value");
        number.label = one->child_text("si:label");
        const std::string own = one->child_text("si:unit");
        unit(own.empty() ? element.child_text("si:listUnit") : own, *one, number);
        uncertainty_in(*one, {&number, 1});
        // What is stated for the whole list is for the elements that state nothing themselves.
        if (number.kind == "none") {
            uncertainty_in(element, {&number, 1});
        }
        form.numbers.push_back(number);
    }
    return form;
}

Form Reader::xml_list_of_reals(const XmlElement& element) {
    Form form{.numbers = {}, .list = true};
    const auto words_of = [&](const char* name) {
        const XmlElement* const child = element.child(name);
        return child == nullptr ? std::vector<std::string>() : xml_list(child->text);
    };
    const std::vector<std::string> values = words_of("si:valueXMLList");
    require_few_numbers(values.size(), element);
    const std::vector<std::string> units = words_of("si:unitXMLList");
    const std::vector<std::string> labels = words_of("si:labelXMLList");
    if (units.size() > 1 && units.size() != values.size()) {
        wrong_length(element, units.size(), values.size(), "the values are imported without a unit");
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
        ImportedNumber number;
        number.value = values[i];
        number.label = entry(labels, i, values.size()).value_or("");
        if (const auto stated = entry(units, i, values.size()); stated) {
            unit(*stated, element, number);
        }
        form.numbers.push_back(number);
    }
    uncertainty_in(element, form.numbers);
    return form;
}

/// Both parts of a complex number are numbers without uncertainty here: theirs is a matrix.
Form Reader::complex_numbers(const XmlElement& element) {
    Form form{.numbers = {}, .list = element.name != "si:complex"};
    for (const char* part : {"si:valueReal", "si:valueImag", "si:valueMagnitude", "si:valuePhase"}) {
        for (const std::string& spelling : {std::string(part), std::string(part) + "XMLList"}) {
            const XmlElement* const values = element.child(spelling);
            const std::vector<std::string> words =
                values == nullptr ? std::vector<std::string>() : xml_list(values->text);
            const bool phase = std::string_view(part) == "si:valuePhase";
            const std::string one = element.child_text(phase ? "si:unitPhase" : "si:unit");
            const std::vector<std::string> units =
                xml_list(one.empty() ? element.child_text(phase ? "si:unitPhaseXMLList" : "si:unitXMLList") : one);
            for (std::size_t i = 0; i < words.size(); ++i) {
                ImportedNumber number;
                number.value = words[i];
                unit(entry(units, i, words.size()).value_or(""), element, number);
                form.numbers.push_back(number);
            }
        }
    }
    for (const XmlElement* one : element.children_named("si:complex")) {
        const Form inner = complex_numbers(*one);
        form.numbers.insert(form.numbers.end(), inner.numbers.begin(), inner.numbers.end());
    }
    remark("GC-DCC-0020", element, "complex numbers",
           "the uncertainty of a complex number is a covariance matrix, which is not imported",
           "state uncertainties and correlation of both parts in the job");
    return form;
}

Form Reader::nested_list(const XmlElement& element) {
    Form form{.numbers = {}, .list = true};
    for (const XmlElement& child : element.children) {
        for (const Form& inner : forms_of(child)) {
            form.numbers.insert(form.numbers.end(), inner.numbers.begin(), inner.numbers.end());
        }
    }
    return form;
}

/// The same quantity in each of the units that the document states it in; one form but for si:hybrid.
std::vector<Form> Reader::forms_of(const XmlElement& element) {
    for (const char* matrix : {"si:measurementUncertaintyMultivariateXMLList",
                               "si:measurementUncertaintyBivariateXMLList", "si:ellipsoidalRegion",
                               "si:rectangularRegion", "si:ellipsoidalRegionXMLList", "si:rectangularRegionXMLList"}) {
        if (const XmlElement* const found = element.child(matrix); found != nullptr) {
            remark("GC-DCC-0023", *found, "a covariance matrix", "covariances are not imported",
                   "state them in the job under `covariance`");
        }
    }
    if (element.name == "si:real" || element.name == "si:constant") {
        return {real(element)};
    }
    if (element.name == "si:realList") {
        return {real_list(element)};
    }
    if (element.name == "si:realListXMLList") {
        return {xml_list_of_reals(element)};
    }
    if (element.name == "si:complex" || element.name == "si:complexList" || element.name == "si:complexListXMLList") {
        return {complex_numbers(element)};
    }
    if (element.name == "si:list") {
        return {nested_list(element)};
    }
    std::vector<Form> forms;
    if (element.name == "si:hybrid") {
        for (const XmlElement& child : element.children) {
            const std::vector<Form> of_child = forms_of(child);
            forms.insert(forms.end(), of_child.begin(), of_child.end());
        }
    }
    return forms;
}

std::string Reader::free_name(const std::string& base, const std::string& result, std::size_t rows) {
    const auto row_name = [&](const std::string& name, std::size_t row) {
        return rows > 1 ? name + "_" + std::to_string(row + 1) : name;
    };
    const auto free = [&](const std::string& name) {
        for (std::size_t row = 0; row < rows; ++row) {
            if (names_.contains(row_name(name, row))) {
                return false;
            }
        }
        return true;
    };
    std::string name = base;
    const std::string longer = result.empty() ? base : result + "_" + base;
    if (!free(name)) {
        // Names are never given back: the search goes on where the last one of the same words ended.
        std::size_t& n = next_version_.try_emplace({longer, rows}, 1).first->second;
        do {
            name = n == 1 ? longer : longer + "_v" + std::to_string(n);
            ++n;
        } while (!free(name));
    }
    for (std::size_t row = 0; row < rows; ++row) {
        names_.insert(row_name(name, row));
    }
    return name;
}

/// The beginning of the names of a quantity: its symbol where it has an uncertainty (an input of a model is called by
/// it), else its name in English, its reference type, or what it is part of.
std::string Reader::base_name(const XmlElement& quantity, const Context& context, const Form& form) {
    const bool one_label = std::all_of(form.numbers.begin(), form.numbers.end(),
                                       [&](const ImportedNumber& n) { return n.label == form.numbers.front().label; });
    std::string base = one_label && form.has_uncertainty() && context.role == "result"
                           ? name_of_label(form.numbers.front().label)
                           : "";
    if (base.empty()) {
        base = as_name(content_in(quantity.child("dcc:name"), "en"));
    }
    if (base.empty()) {
        base = name_of_ref_type(quantity.attribute("refType"));
    }
    if (base.empty()) {
        base = as_name(context.result_en);
    }
    return base.empty() ? "quantity" : base;
}

/// Whether the accreditation of the issuer covers one row of a quantity, where it says so.
void add_scope(const XmlElement& quantity, std::size_t row, std::size_t rows, ImportedQuantity& imported) {
    const XmlElement* const meta = quantity.child("dcc:measurementMetaData");
    if (meta == nullptr) {
        return;
    }
    for (const XmlElement* data : meta->children_named("dcc:metaData")) {
        const std::vector<std::string> types = xml_list(data->attribute("refType"));
        if (std::find(types.begin(), types.end(), "basic_isInCMC") == types.end()) {
            continue;
        }
        const XmlElement* const list = data->child("dcc:validXMLList");
        const XmlElement* const one = list == nullptr ? data->child("dcc:valid") : list;
        const std::optional<std::string> word = one == nullptr ? std::nullopt : entry(xml_list(one->text), row, rows);
        if (word && (*word == "true" || *word == "1" || *word == "false" || *word == "0")) {
            imported.in_scope = *word == "true" || *word == "1";
        }
    }
}

/// The statement of conformity of one row of a quantity.
void add_conformity(const XmlElement& quantity, std::size_t row, std::size_t rows, ImportedQuantity& imported) {
    const XmlElement* const meta = quantity.child("dcc:measurementMetaData");
    if (meta == nullptr) {
        return;
    }
    for (const XmlElement* data : meta->children_named("dcc:metaData")) {
        const XmlElement* const list = data->child("dcc:conformityXMLList");
        const XmlElement* const one = list == nullptr ? data->child("dcc:conformity") : list;
        const std::optional<std::string> word = one == nullptr ? std::nullopt : entry(xml_list(one->text), row, rows);
        // There may be several statements, one for each specification. "noPass" also stands in rows that a
        // specification does not apply to, so any other word takes its place.
        if (word && (imported.conformity.empty() || imported.conformity == "noPass")) {
            imported.conformity = *word;
            imported.conformity_id = data->attribute("refId");
            imported.conformity_declaration = content_in(data->child("dcc:declaration"), "en");
        }
    }
}

void Reader::add_rows(const XmlElement& quantity, const Context& context, const Form& main,
                      const std::vector<const Form*>& others, const std::string& note) {
    const std::size_t rows = main.numbers.size();
    if (rows == 0) {
        return;
    }
    require_few_numbers(out_.quantities.size() + rows, quantity);
    const std::string result_name = as_name(context.result_en);
    const std::string symbol = base_name(quantity, context, main);
    const std::string base = free_name(symbol, result_name, rows);
    for (std::size_t row = 0; row < rows; ++row) {
        ImportedQuantity imported;
        static_cast<ImportedNumber&>(imported) = main.numbers[row];
        imported.name = rows > 1 ? base + "_" + std::to_string(row + 1) : base;
        imported.column = base;
        imported.symbol = symbol;
        imported.result = context.result;
        imported.result_name = result_name;
        imported.quantity = first_content(quantity.child("dcc:name"));
        imported.ref_type = quantity.attribute("refType");
        imported.id = quantity.attribute("id");
        imported.role = context.role;
        imported.table = context.table;
        imported.before_adjustment = context.before_adjustment;
        if (main.list) {
            imported.row = row;
        }
        if (context.items && (context.items->size() == 1 || context.items->size() == rows)) {
            imported.about = (*context.items)[context.items->size() == 1 ? 0 : row];
        }
        for (const Form* other : others) {
            imported.also.push_back(other->numbers[row]);
        }
        imported.remark = note;
        add_scope(quantity, row, rows, imported);
        add_conformity(quantity, row, rows, imported);
        out_.quantities.push_back(std::move(imported));
    }
}

void Reader::add_quantity(const XmlElement& quantity, const Context& context) {
    std::string note;
    if (quantity.child("dcc:relativeUncertainty") != nullptr) {
        note = "the certificate also states a relative uncertainty";
    }
    if (const XmlElement* const words = quantity.child("dcc:charsXMLList"); words != nullptr && context.table > 0) {
        out_.words.push_back({.table = context.table,
                              .quantity = first_content(quantity.child("dcc:name")),
                              .words = xml_list(words->text),
                              .before_adjustment = context.before_adjustment});
    }
    for (const XmlElement& child : quantity.children) {
        const std::vector<Form> forms = forms_of(child);
        if (forms.empty()) {
            continue;
        }
        // Of the same quantity in two units the one with the uncertainty is imported: a value without one would become
        // a constant.
        auto main = std::find_if(forms.begin(), forms.end(), [](const Form& f) { return f.has_uncertainty(); });
        main = main == forms.end() ? forms.begin() : main;
        std::vector<const Form*> others;
        std::vector<const Form*> apart;
        for (auto form = forms.begin(); form != forms.end(); ++form) {
            if (form != main) {
                (form->numbers.size() == main->numbers.size() ? others : apart).push_back(&*form);
            }
        }
        add_rows(quantity, context, *main, others, note);
        for (const Form* form : apart) {
            add_rows(quantity, context, *form, {}, "another unit of the same quantity, with another number of values");
        }
    }
}

/// dcc:positionCoordinate1 …, dcc:relativeUncertaintySingle: of the type of si:real, but named otherwise.
void Reader::add_position(const XmlElement& coordinate, const Context& context) {
    Context inner = context;
    inner.result_en = coordinate.name.substr(coordinate.name.find(':') + 1);
    add_rows(coordinate, inner, real(coordinate), {}, "");
}

/// The items that an element refers to. Empty where it refers to something else, or where there is one item only.
std::vector<std::size_t> Reader::items_of(const XmlElement& element) const {
    std::vector<std::size_t> found;
    if (out_.items.size() < 2) {
        return found;
    }
    for (const std::string& id : xml_list(element.attribute("refId"))) {
        const auto item = item_of_id_.find(id);
        // With one unknown reference the order of the others no longer fits the rows of the table.
        if (item == item_of_id_.end()) {
            return {};
        }
        found.push_back(item->second);
    }
    return found;
}

/// Whether the results in an element are those before an adjustment; nothing where it does not say, or says both.
std::optional<bool> is_before_adjustment(const XmlElement& element) {
    const XmlElement* const conditions = element.child("dcc:influenceConditions");
    bool before = false, after = false;
    if (conditions != nullptr) {
        for (const XmlElement* condition : conditions->children_named("dcc:influenceCondition")) {
            const XmlElement* const status = condition->child("dcc:status");
            const std::vector<std::string> words =
                status == nullptr ? std::vector<std::string>() : xml_list(status->text);
            before = before || (words.size() == 1 && words.front() == "beforeAdjustment");
            after = after || (words.size() == 1 && words.front() == "afterAdjustment");
        }
    }
    return before == after ? std::nullopt : std::optional(before);
}

void Reader::walk(const XmlElement& element, Context context) {
    static constexpr std::array<std::pair<const char*, const char*>, 7> k_roles{
        {{"dcc:influenceCondition", "influence_condition"},
         {"dcc:metaData", "meta_data"},
         {"dcc:statement", "statement"},
         {"dcc:measuringEquipment", "equipment"},
         {"dcc:usedMethod", "method"},
         {"dcc:item", "item"},
         {"dcc:positionCoordinates", "location"}}};
    for (const auto& [name, role] : k_roles) {
        if (element.name == name) {
            context.role = role;
        }
    }
    if (const std::optional<bool> own = is_before_adjustment(element)) {
        context.before_adjustment = own;
    }
    if (element.name == "dcc:list") {
        context.table = ++tables_;
    } else if (element.name == "dcc:metaData") {
        context.table = 0;  // limits and the like are no columns of the table
    }
    const bool named =
        element.name == "dcc:result" || element.name == "dcc:measurementResult" || context.role != "result";
    if (const XmlElement* const name = element.child("dcc:name");
        named && name != nullptr && element.name != "dcc:quantity") {
        context.result = first_content(name);
        context.result_en = content_in(name, "en");
    }
    if (std::vector<std::size_t> items = items_of(element); !items.empty()) {
        context.items = std::make_shared<const std::vector<std::size_t>>(std::move(items));
    }
    if (element.child("si:value") != nullptr) {
        add_position(element, context);
        return;
    }
    if (element.child("si:valueXMLList") != nullptr) {  // dcc:relativeUncertaintyXmlList
        add_rows(element, {context.role, context.result, "relative_uncertainty", 0, nullptr, context.before_adjustment},
                 xml_list_of_reals(element), {}, "a relative uncertainty of the quantity before");
        return;
    }
    add_quantity(element, context);
    for (const XmlElement& child : element.children) {
        if (!child.name.starts_with("si:")) {
            walk(child, context);
        }
    }
}

const XmlElement* descend(const XmlElement* from, std::initializer_list<const char*> names) {
    for (const char* name : names) {
        from = from == nullptr ? nullptr : from->child(name);
    }
    return from;
}

/// What a document says of itself: this program marks drafts, specimens and what is superseded; others write it in the number.
std::string state_of(const XmlElement& root, const std::string& identifier) {
    std::string state;
    for_each_element(root, [&](const XmlElement& e) {
        const std::string ref_type = e.name == "dcc:statement" ? e.attribute("refType") : "";
        if (ref_type == "gumcert_draft" || (ref_type == "gumcert_specimen" && state.empty())) {
            state = ref_type.substr(ref_type.find('_') + 1);
        } else if (ref_type == "gumcert_superseded" && state.empty()) {
            state = "superseded document";
        }
    });
    const std::string words = "_" + as_name(identifier) + "_";
    for (const auto& [word, meaning] :
         {std::pair("draft", "draft"), std::pair("entwurf", "draft"), std::pair("borrador", "draft"),
          std::pair("specimen", "specimen"), std::pair("muster", "specimen")}) {
        if (state.empty() && words.find("_" + std::string(word) + "_") != std::string::npos) {
            state = meaning;
        }
    }
    return state;
}

std::vector<ImportedItem> items_of(const XmlElement& root) {
    constexpr std::size_t k_most_identifications = 4;  // of one item: every number about it repeats them
    std::vector<ImportedItem> items;
    for_each_element(root, [&](const XmlElement& e) {
        if (e.name != "dcc:item" || e.attribute("id").empty()) {
            return;
        }
        ImportedItem& item = items.emplace_back();
        item.id = e.attribute("id");
        item.name = first_content(e.child("dcc:name"));
        if (const XmlElement* const all = e.child("dcc:identifications"); all != nullptr) {
            for (const XmlElement* one : all->children_named("dcc:identification")) {
                if (item.identifications.size() == k_most_identifications) {
                    return;
                }
                const std::string called = first_content(one->child("dcc:name"));
                item.identifications.push_back((called.empty() ? "" : called + " ") + one->child_text("dcc:value"));
            }
        }
    });
    return items;
}

std::string trimmed_or_empty(const XmlElement* element) {
    return element == nullptr ? "" : element->trimmed();
}

ImportedCertificate certificate_of(const XmlElement& root, std::string_view bytes, const std::string& file) {
    ImportedCertificate out;
    out.schema_version = root.attribute("schemaVersion");
    const XmlElement* const administrative = root.child("dcc:administrativeData");
    const XmlElement* const core = descend(administrative, {"dcc:coreData"});
    out.identifier = trimmed_or_empty(descend(core, {"dcc:uniqueIdentifier"}));
    out.issued = trimmed_or_empty(descend(core, {"dcc:issueDate"}));
    out.performed_from = trimmed_or_empty(descend(core, {"dcc:beginPerformanceDate"}));
    out.performed_to = trimmed_or_empty(descend(core, {"dcc:endPerformanceDate"}));
    out.laboratory = first_content(descend(administrative, {"dcc:calibrationLaboratory", "dcc:contact", "dcc:name"}));
    out.item = first_content(descend(administrative, {"dcc:items", "dcc:item", "dcc:name"}));
    out.sha256 = encoding::sha256(bytes);
    out.state = state_of(root, out.identifier);
    out.items = items_of(root);
    Reader reader(file, out);
    reader.walk(root, {});
    return out;
}

}  // namespace

bool may_be_of_one_stage(const std::optional<bool>& before_adjustment, const std::optional<bool>& other) {
    return !before_adjustment || !other || *before_adjustment == *other;
}

ImportedCertificate read_dcc(std::string_view bytes, const std::string& file) {
    return certificate_of(read_dcc_root(bytes, file), bytes, file);
}

ParsedDcc parse_dcc(std::string bytes, const std::string& file) {
    XmlElement root = read_dcc_root(bytes, file);
    ImportedCertificate certificate = certificate_of(root, bytes, file);
    return {.bytes = std::move(bytes), .root = std::move(root), .certificate = std::move(certificate)};
}

}  // namespace gumcert::reports
