#include "reports/dcc/dcc_rules.h"

#include "reports/printable_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <set>
#include <string_view>

#include "gum/quantity/unit.h"
#include "reports/dcc/breach_limits.h"
#include "reports/dcc/d_si_unit.h"
#include "reports/dcc/dcc_document.h"
#include "reports/dcc/dcc_element.h"
#include "reports/dcc/dcc_statements.h"
#include "reports/dcc/dcc_structure.h"
#include "reports/dcc/printed_number.h"
#include "reports/view/certificate_view.h"

namespace gumcert::reports {

namespace {

// ISO 639-1, the two-letter codes.
constexpr std::string_view k_languages =
    " aa ab ae af ak am an ar as av ay az ba be bg bh bi bm bn bo br bs ca ce ch co cr cs cu cv cy da de dv dz ee el "
    "en "
    "eo es et eu fa ff fi fj fo fr fy ga gd gl gn gu gv ha he hi ho hr ht hu hy hz ia id ie ig ii ik io is it iu ja jv "
    "ka kg ki kj kk kl km kn ko kr ks ku kv kw ky la lb lg li ln lo lt lu lv mg mh mi mk ml mn mr ms mt my na nb nd ne "
    "ng nl nn no nr nv ny oc oj om or os pa pi pl ps pt qu rm rn ro ru rw sa sc sd se sg si sk sl sm sn so sq sr ss st "
    "su sv sw ta te tg th ti tk tl tn to tr ts tt tw ty ug uk ur uz ve vi vo wa wo xh yi yo za zh zu ";

std::string quoted(const std::string& text) {
    return '"' + shortened(printable(text), k_shown) + '"';
}

bool is_blank_only(const std::string& text) {
    return without_outer_blanks(text).empty();
}

class Rules {
public:
    Rules(const XmlElement& root, std::string file) : root_(root), file_(std::move(file)) {
        const XmlElement* const administrative = root.child("dcc:administrativeData");
        core_ = administrative == nullptr ? nullptr : administrative->child("dcc:coreData");
    }

    std::vector<gum::Diagnostic> all() {
        methods_and_conditions();
        newest_version();
        references();
        languages();
        dates();
        releases();
        lists();
        one_unit_a_list();
        units_outside_of_the_si();
        relative_uncertainties();
        no_empty_elements();
        return std::move(found_);
    }

private:
    void report(const char* code, const XmlElement& at, const std::string& what, const std::string& rule,
                const std::string& action, gum::Severity severity = gum::Severity::error) {
        // One mistake of a program is in every row of its tables. The first ones tell all there is to know.
        if (found_.size() == k_most_breaches) {
            return;
        }
        found_.push_back({.code = code,
                          .where = place_of(at, file_),
                          .what = what,
                          .rule = rule,
                          .action = action,
                          .severity = severity});
    }

    void methods_and_conditions();
    void newest_version();
    void references();
    void languages();
    void contents_of(const XmlElement& text, const std::vector<std::string>& used);
    void dates();
    void releases();
    void lists();
    void list_lengths(const XmlElement& reals);
    void meta_data_lengths(const XmlElement& quantity);
    void spacing(const XmlElement& list);
    void one_unit_a_list();
    void units_outside_of_the_si();
    void relative_uncertainties();
    void relative_uncertainty(const XmlElement& quantity);
    bool contradicts(const XmlElement& relative, const XmlElement& form, double scale);
    void no_empty_elements();

    const XmlElement& root_;
    const XmlElement* core_ = nullptr;
    std::string file_;
    std::vector<gum::Diagnostic> found_;
};

// Rule 1: methods, conditions and software of every result, stated for it or for all.
void Rules::methods_and_conditions() {
    const XmlElement* const results = root_.child("dcc:measurementResults");
    if (results == nullptr) {
        return;
    }
    for (const XmlElement* result : results->children_named("dcc:measurementResult")) {
        for (const char* part : {"dcc:usedMethods", "dcc:influenceConditions", "dcc:usedSoftware"}) {
            bool stated = results->child(part) != nullptr;
            for_each_element(*result, [&](const XmlElement& e) { stated = stated || e.name == part; });
            if (!stated) {
                const bool software = std::string_view(part) == "dcc:usedSoftware";
                report("GC-DCC-0101", *result, "a result without " + std::string(part).substr(4),
                       "every result states its methods, conditions and software",
                       "state them for the result or for all of them",
                       software ? gum::Severity::warning : gum::Severity::error);
            }
        }
    }
}

// Rule 2.
void Rules::newest_version() {
    const std::string version = root_.attribute("schemaVersion");
    if (version != "3.3.0") {
        report("GC-DCC-0102", root_, "version " + quoted(version), "new certificates use the newest version, 3.3.0",
               "nothing, if the certificate is older", gum::Severity::warning);
    }
}

// Rule 3: references inside of the document.
void Rules::references() {
    std::set<std::string, std::less<>> ids;
    std::set<std::string, std::less<>> referred;
    for_each_element(root_, [&](const XmlElement& e) {
        const bool own = e.name.starts_with("dcc:");
        if (const std::string id = e.attribute("id"); own && !id.empty() && !ids.insert(id).second) {
            report("GC-DCC-0103", e, "the id " + quoted(id) + " stands twice", "an id names one element",
                   "choose different ids");
        }
        for (const std::string& id : xml_list(e.attribute("refId"))) {
            referred.insert(id);
        }
    });
    for_each_element(root_, [&](const XmlElement& e) {
        for (const std::string& id : xml_list(e.attribute("refId"))) {
            if (!ids.contains(id)) {
                report("GC-DCC-0103", e, "refId " + quoted(id) + " without an element of that id",
                       "a reference leads to an element", "correct the reference");
            }
        }
        const std::string id = e.attribute("id");
        if (e.name.starts_with("dcc:") && !id.empty() && !referred.contains(id)) {
            report("GC-DCC-0103", e, "nothing refers to the id " + quoted(id), "every id is referred to",
                   "leave out the id", gum::Severity::warning);
        }
    });
}

// Rule 4: languages.
void Rules::languages() {
    if (core_ == nullptr) {
        return;
    }
    std::vector<std::string> used;
    for (const XmlElement* e : core_->children_named("dcc:usedLangCodeISO639_1")) {
        const std::string code = e->trimmed();
        if (code.size() != 2 || k_languages.find(" " + code + " ") == std::string_view::npos) {
            report("GC-DCC-0104", *e, "language " + quoted(code), "languages are codes of ISO 639-1",
                   "correct the code");
        }
        if (std::find(used.begin(), used.end(), code) != used.end()) {
            report("GC-DCC-0104", *e, "language " + quoted(code) + " is declared twice",
                   "every language is declared once", "leave out one of them");
        }
        used.push_back(code);
    }
    for (const XmlElement* e : core_->children_named("dcc:mandatoryLangCodeISO639_1")) {
        if (std::find(used.begin(), used.end(), e->trimmed()) == used.end()) {
            report("GC-DCC-0104", *e, "binding language " + quoted(e->trimmed()) + " is not among the used ones",
                   "binding languages are used ones", "declare it as used");
        }
    }
    for_each_element(root_, [&](const XmlElement& e) {
        if (e.child("dcc:content") != nullptr) {
            contents_of(e, used);
        }
    });
}

void Rules::contents_of(const XmlElement& text, const std::vector<std::string>& used) {
    const std::vector<const XmlElement*> contents = text.children_named("dcc:content");
    std::vector<std::string> found;
    for (const XmlElement* content : contents) {
        found.push_back(content->attribute("lang"));
    }
    if (found == std::vector<std::string>{""}) {
        return;  // one text for all languages
    }
    std::vector<std::string> sorted = found;
    std::vector<std::string> wanted = used;
    std::sort(sorted.begin(), sorted.end());
    std::sort(wanted.begin(), wanted.end());
    if (sorted != wanted) {
        std::string languages;
        for (const std::string& language : found) {
            languages += (languages.empty() ? "" : ", ") + (language.empty() ? "none" : language);
        }
        report("GC-DCC-0104", text, "texts in the languages: " + shortened(printable(languages), k_shown),
               "a text stands in every used language once, or once without a language",
               "add the languages that are missing, or leave out the attribute");
    }
}

// Rule 5.
void Rules::dates() {
    if (core_ == nullptr) {
        return;
    }
    constexpr std::size_t k_date = 10;  // "2026-11-21", before a time zone; such texts sort as the dates do
    const std::string begin = core_->child_text("dcc:beginPerformanceDate").substr(0, k_date);
    const std::string end = core_->child_text("dcc:endPerformanceDate").substr(0, k_date);
    if (!begin.empty() && !end.empty() && begin > end) {
        report("GC-DCC-0105", *core_, "performed from " + quoted(begin) + " to " + quoted(end),
               "a calibration begins before it ends", "correct the dates");
    }
}

bool is_release(std::string_view text) {
    const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    if (text.empty() || !letter(text.front())) {
        return false;
    }
    text.remove_prefix(1);
    constexpr int k_most_groups = 4;
    int groups = 0;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('.'), text.size());
        const std::string_view group = text.substr(0, end);
        if (group.empty() || !std::all_of(group.begin(), group.end(), [](char c) { return c >= '0' && c <= '9'; })) {
            return false;
        }
        ++groups;
        if (end + 1 == text.size()) {
            return false;  // a dot at the end
        }
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return groups >= 1 && groups <= k_most_groups;
}

// Rule 6: releases of software look like v1.2.3.
void Rules::releases() {
    for_each_element(root_, [&](const XmlElement& e) {
        const XmlElement* const release = e.name == "dcc:software" ? e.child("dcc:release") : nullptr;
        if (release != nullptr && !is_release(release->trimmed())) {
            report("GC-DCC-0106", *release, "release " + quoted(release->trimmed()),
                   "a release is a letter and up to four groups of digits: v1.2.3", "write it so");
        }
    });
}

// Rule 7: lists.
void Rules::lists() {
    for_each_element(root_, [&](const XmlElement& e) {
        if (e.name.ends_with("XMLList") && e.children.empty()) {
            spacing(e);
        }
        if (e.name == "si:realListXMLList") {
            list_lengths(e);
        }
        if (e.name == "dcc:quantity") {
            meta_data_lengths(e);
        }
    });
}

void Rules::spacing(const XmlElement& list) {
    std::string expected;
    for (const std::string& word : xml_list(list.text)) {
        expected += (expected.empty() ? "" : " ") + word;
    }
    if (!expected.empty() && list.text != expected) {
        report("GC-DCC-0107", list, list.name.substr(list.name.find(':') + 1) + " with other blanks",
               "one blank stands between the entries of a list, and none at its ends", "correct the blanks");
    }
}

void Rules::list_lengths(const XmlElement& reals) {
    const XmlElement* const values = reals.child("si:valueXMLList");
    const std::size_t count = values == nullptr ? 0 : xml_list(values->text).size();
    const auto check = [&](const auto& self, const XmlElement& e) -> void {
        if (e.name == "si:covarianceMatrixXMLList") {
            return;  // a matrix has lengths of its own
        }
        const std::size_t length = xml_list(e.text).size();
        if (&e != &reals && e.name.ends_with("XMLList") && e.children.empty() && length != 1 && length != count) {
            report("GC-DCC-0107", e, std::to_string(length) + " entries beside " + std::to_string(count) + " values",
                   "a list has one entry, or as many as there are values", "correct the list");
        }
        for (const XmlElement& child : e.children) {
            self(self, child);
        }
    };
    check(check, reals);
}

/// Number of values of a quantity that is a list; 0 for others.
std::size_t values_of(const XmlElement& quantity) {
    const XmlElement* reals = quantity.child("si:realListXMLList");
    if (const XmlElement* const hybrid = quantity.child("si:hybrid"); hybrid != nullptr) {
        reals = hybrid->child("si:realListXMLList");
    }
    const XmlElement* const values = reals == nullptr ? nullptr : reals->child("si:valueXMLList");
    return values == nullptr ? 0 : xml_list(values->text).size();
}

void Rules::meta_data_lengths(const XmlElement& quantity) {
    const XmlElement* const meta = quantity.child("dcc:measurementMetaData");
    const std::size_t count = values_of(quantity);
    if (meta == nullptr || count == 0) {
        return;
    }
    for (const XmlElement* data : meta->children_named("dcc:metaData")) {
        for (const char* name : {"dcc:conformityXMLList", "dcc:validXMLList"}) {
            const XmlElement* const list = data->child(name);
            const std::size_t length = list == nullptr ? 1 : xml_list(list->text).size();
            if (length != 1 && length != count) {
                report("GC-DCC-0107", *list,
                       std::to_string(length) + " entries beside " + std::to_string(count) + " values",
                       "a list has one entry, or as many as there are values", "correct the list");
            }
        }
    }
}

// Rule 8: a warning, for a vector of parameters with their covariance cannot do without.
void Rules::one_unit_a_list() {
    for_each_element(root_, [&](const XmlElement& e) {
        if (e.name != "si:unitXMLList") {
            return;
        }
        const std::vector<std::string> units = xml_list(e.text);
        if (std::any_of(units.begin(), units.end(), [&](const std::string& u) { return u != units.front(); })) {
            report("GC-DCC-0108", e, "several units in one list", "the values of a list share a unit",
                   "nothing for a vector of parameters; else write a list for each unit", gum::Severity::warning);
        }
    });
}

// Rule 9: units that D-SI does not have begin with "|".
void Rules::units_outside_of_the_si() {
    std::set<std::string, std::less<>> defined;
    for_each_element(root_, [&](const XmlElement& e) {
        const std::string unit = e.child_text("dcc:nonSIUnit");
        if (!unit.empty() && !e.child_text("dcc:nonSIDefinition").empty()) {
            defined.insert(unit.starts_with('|') ? unit.substr(1) : unit);
        }
    });
    for_each_element(root_, [&](const XmlElement& e) {
        const bool is_unit = e.name == "si:unit" || e.name == "si:unitXMLList" || e.name == "si:listUnit";
        for (const std::string& unit : is_unit ? xml_list(e.text) : std::vector<std::string>()) {
            if (unit.starts_with('|') && !defined.contains(unit.substr(1))) {
                report("GC-DCC-0109", e, "unit " + quoted(unit) + " without a definition",
                       "a unit outside of the SI has nonSIDefinition and nonSIUnit", "define it in the meta data");
            }
        }
    });
}

// Rule 10: a relative uncertainty says the same as the absolute one beside it.
void Rules::relative_uncertainties() {
    for_each_element(root_, [&](const XmlElement& e) {
        if (e.child("dcc:relativeUncertainty") != nullptr) {
            relative_uncertainty(e);
        }
    });
}

/// Words of the first element of one of these names anywhere inside; empty without one.
std::vector<std::string> words_inside(const XmlElement& element, std::initializer_list<std::string_view> names) {
    std::vector<std::string> words;
    for_each_element(element, [&](const XmlElement& e) {
        if (words.empty() && std::find(names.begin(), names.end(), e.name) != names.end()) {
            words = xml_list(e.text);
        }
    });
    return words;
}

std::optional<PrintedNumber> number_at(const std::vector<std::string>& words, std::size_t i) {
    if (words.empty() || (words.size() > 1 && i >= words.size())) {
        return std::nullopt;
    }
    return printed_number(words.size() == 1 ? words.front() : words[i]);
}

/// How much one is in a unit of dimension one: 0.01 for \percent. Nothing for another unit, or one that is not known.
std::optional<double> ratio_of(const std::vector<std::string>& unit) {
    const auto known = unit.empty() ? std::optional<std::string>("1") : unit_from_d_si(unit.front());
    if (!known) {
        return std::nullopt;
    }
    const gum::Unit read = gum::Unit::parse(*known);
    return read.dimension().is_one() ? std::optional(read.difference_to_si(1.0)) : std::nullopt;
}

/// Numbers with their unit: si:real, si:realListXMLList, alone or each in si:hybrid.
void for_each_form(const XmlElement& quantity, const std::function<void(const XmlElement&)>& visit) {
    for (const XmlElement& form : quantity.children) {
        if (form.name == "si:hybrid") {
            for_each_form(form, visit);
        } else if (form.name == "si:real" || form.name == "si:realListXMLList") {
            visit(form);
        }
    }
}

void Rules::relative_uncertainty(const XmlElement& quantity) {
    const XmlElement& relative = *quantity.child("dcc:relativeUncertainty");
    const std::optional<double> scale = ratio_of(words_inside(relative, {"si:unit", "si:unitXMLList"}));
    if (!scale) {
        return;
    }
    bool reported = false;
    for_each_form(quantity, [&](const XmlElement& form) {
        const std::vector<std::string> unit = words_inside(form, {"si:unit", "si:unitXMLList"});
        // On a scale with an origin of its own a ratio to the value means nothing.
        const bool has_origin = !unit.empty() && unit.front() == "\\degreecelsius";
        if (!reported && !has_origin) {
            reported = contradicts(relative, form, *scale);
        }
    });
}

/// Reports the first row where the relative uncertainty is not the absolute one divided by the value; the others will
/// have the same reason.
/// \param scale  of the relative uncertainty
bool Rules::contradicts(const XmlElement& relative, const XmlElement& form, double scale) {
    const std::vector<std::string> stated = words_inside(relative, {"si:value", "si:valueXMLList"});
    const std::vector<std::string> values = words_inside(form, {"si:value", "si:valueXMLList"});
    const std::vector<std::string> expanded =
        words_inside(form, {"si:valueExpandedMU", "si:valueExpandedMUXMLList", "si:uncertainty",
                            "si:uncertaintyXMLList", "si:valueStandardMU", "si:valueStandardMUXMLList"});
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto value = number_at(values, i);
        const auto U = number_at(expanded, i);
        const auto w = number_at(stated, i);
        if (!value || !U || !w || value->value == 0.0) {
            continue;
        }
        const double expected = U->value / std::abs(value->value);
        // All three numbers are printed, so each may be off by half a unit of its last digit. The terms are the partial
        // derivatives of U/|y| times these; the sum and not the root of squares, because the largest possible
        // difference is asked for.
        const double allowed = scale * w->half_unit + U->half_unit / std::abs(value->value) +
                               expected * value->half_unit / std::abs(value->value);
        constexpr double k_noise = 1e-9;
        if (std::abs(scale * w->value - expected) > allowed * (1.0 + k_noise)) {
            report("GC-DCC-0110", relative,
                   "relative uncertainty " + stated[stated.size() == 1 ? 0 : i] + " of value " + values[i] +
                       " with uncertainty " + expanded[expanded.size() == 1 ? 0 : i],
                   "the relative uncertainty is the absolute one divided by the value", "correct one of them");
            return true;
        }
    }
    return false;
}

// Rule 11, but for signatures, which have rules of their own.
void Rules::no_empty_elements() {
    const auto check = [&](const auto& self, const XmlElement& e) -> void {
        if (e.name == "ds:Signature") {
            return;
        }
        if (e.children.empty() && is_blank_only(e.text)) {
            report("GC-DCC-0111", e, "the element " + quoted(e.name) + " is empty", "no element is empty",
                   "leave it out");
        }
        for (const XmlElement& child : e.children) {
            self(self, child);
        }
    };
    check(check, root_);
}

}  // namespace

std::vector<gum::Diagnostic> business_rule_breaches(const XmlElement& root, const std::string& file) {
    return Rules(root, file).all();
}

std::vector<gum::Diagnostic> missing_parts(const XmlElement& root, const std::string& file) {
    // Each below the one of the second name, which itself is looked for further up in the list.
    static constexpr std::array<std::pair<const char*, const char*>, 15> k_parts{
        {{"dcc:administrativeData", ""},
         {"dcc:measurementResults", ""},
         {"dcc:dccSoftware", "dcc:administrativeData"},
         {"dcc:coreData", "dcc:administrativeData"},
         {"dcc:items", "dcc:administrativeData"},
         {"dcc:calibrationLaboratory", "dcc:administrativeData"},
         {"dcc:respPersons", "dcc:administrativeData"},
         {"dcc:customer", "dcc:administrativeData"},
         {"dcc:countryCodeISO3166_1", "dcc:coreData"},
         {"dcc:usedLangCodeISO639_1", "dcc:coreData"},
         {"dcc:mandatoryLangCodeISO639_1", "dcc:coreData"},
         {"dcc:uniqueIdentifier", "dcc:coreData"},
         {"dcc:beginPerformanceDate", "dcc:coreData"},
         {"dcc:endPerformanceDate", "dcc:coreData"},
         {"dcc:performanceLocation", "dcc:coreData"}}};
    std::vector<gum::Diagnostic> missing;
    const XmlElement* const administrative = root.child("dcc:administrativeData");
    const XmlElement* const core = administrative == nullptr ? nullptr : administrative->child("dcc:coreData");
    for (const auto& [name, in] : k_parts) {
        const std::string_view holder_name = in;
        const XmlElement* const holder = holder_name.empty()             ? &root
                                         : holder_name == "dcc:coreData" ? core
                                                                         : administrative;
        if (holder != nullptr && holder->child(name) == nullptr) {
            missing.push_back({.code = "GC-DCC-0112",
                               .where = place_of(*holder, file),
                               .what = "no " + std::string(name).substr(4) + " in " + holder->name.substr(4),
                               .rule = "the schema of the DCC demands it",
                               .action = "add it; the schema itself tells the order (docs/digital_certificate.md)"});
        }
    }
    return missing;
}

std::vector<gum::Diagnostic> check_dcc_structure(std::string_view bytes, const std::string& file) {
    return check_dcc_structure(read_dcc_root(bytes, file), file);
}

std::vector<gum::Diagnostic> check_dcc_structure(const XmlElement& root, const std::string& file) {
    return root.attribute("schemaVersion").starts_with("3.0.") ? missing_parts(root, file)
                                                               : schema_breaches(root, file);
}

std::vector<gum::Diagnostic> check_dcc(std::string_view bytes, const std::string& file) {
    return check_dcc(read_dcc_root(bytes, file), file);
}

std::vector<gum::Diagnostic> check_dcc(const XmlElement& root, const std::string& file) {
    std::vector<gum::Diagnostic> found = business_rule_breaches(root, file);
    const std::vector<gum::Diagnostic> statements = contradicting_statements(root, file);
    found.insert(found.end(), statements.begin(), statements.end());
    return found;
}

}  // namespace gumcert::reports
