#include "reports/dcc/dcc_structure.h"

#include "reports/printable_text.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <utility>

#include "reports/dcc/breach_limits.h"
#include "reports/dcc/content_model.h"
#include "reports/dcc/dcc_schema_facts.h"
#include "reports/dcc/dcc_text_types.h"
#include "reports/view/certificate_view.h"

namespace gumcert::reports {

namespace {

constexpr int k_first_version = 310;

/// 331 for "3.3.1"; 0 for a text that is no version.
int version_of(const std::string& text) {
    const bool shape = text.size() == 5 && text[1] == '.' && text[3] == '.';
    return shape ? 100 * (text[0] - '0') + 10 * (text[2] - '0') + (text[4] - '0') : 0;
}

const ElementTypes& types_of(int version) {
    static std::mutex mutex;
    static std::map<int, ElementTypes> all;
    const std::lock_guard lock(mutex);
    const auto found = all.find(version);
    return found != all.end() ? found->second
                              : all.emplace(version, element_types(dcc_schema_facts(), version)).first->second;
}

/// A name without the prefix of a namespace that everybody knows.
std::string short_name(const std::string& name) {
    const std::size_t colon = name.starts_with("dcc:") ? 4 : name.starts_with("si:") ? 3 : 0;
    return shortened(printable(name.substr(colon)), k_shown);
}

/// "a", "a or b", "a, b or c"
std::string choice_of(const std::set<std::string>& names) {
    std::string text;
    std::size_t left = names.size();
    for (const std::string& name : names) {
        --left;
        text += name + (left > 1 ? ", " : left == 1 ? " or " : "");
    }
    return text;
}

/// The children of one element on their way through the model.
class Walk {
public:
    explicit Walk(const ContentModel& model) : model_(model), open_(model.first) {}

    /// The place of a child that may stand here; nothing where it may not.
    const ContentModel::Place* step(const std::string& element) {
        if (model_.any_order) {
            const ContentModel::Place* const place = any_place(element);
            return place != nullptr && seen_.insert(element).second ? place : nullptr;
        }
        for (const std::size_t i : open_) {
            if (model_.places[i].element == element) {
                go_to(i);
                return &model_.places[i];
            }
        }
        return nullptr;
    }
    /// Goes on behind a later place of a child, over what is missing in between; nothing where there is none. So one
    /// missing element is reported once, and not again for each element behind it.
    const ContentModel::Place* leap(const std::string& element) {
        for (std::size_t i = model_.any_order ? model_.places.size() : at_; i < model_.places.size(); ++i) {
            if (model_.places[i].element == element && !open_.contains(i) && (i > at_ || !begun_)) {
                go_to(i);
                return &model_.places[i];
            }
        }
        return nullptr;
    }
    [[nodiscard]] const ContentModel::Place* any_place(const std::string& element) const {
        const auto found = std::find_if(model_.places.begin(), model_.places.end(),
                                        [&](const ContentModel::Place& p) { return p.element == element; });
        return found == model_.places.end() ? nullptr : &*found;
    }
    /// What has to come before the walk can end, or before a place: the elements that nothing can stand for, else all
    /// that may stand here.
    [[nodiscard]] std::set<std::string> missing() const {
        std::set<std::string> needed;
        if (model_.any_order) {
            for (const ContentModel::Place& place : model_.places) {
                if (place.required && !seen_.contains(place.element)) {
                    needed.insert(short_name(place.element));
                }
            }
            return needed;
        }
        if (may_end()) {
            return needed;
        }
        std::set<std::string> possible;
        for (const std::size_t i : open_) {
            if (begun_ && i <= at_) {
                continue;  // one more of the same
            }
            (model_.places[i].required ? needed : possible).insert(short_name(model_.places[i].element));
        }
        return needed.empty() ? possible : needed;
    }
    [[nodiscard]] std::set<std::string> possible() const {
        std::set<std::string> names;
        for (const std::size_t i : open_) {
            names.insert(short_name(model_.places[i].element));
        }
        return names;
    }

private:
    void go_to(std::size_t i) {
        at_ = i;
        begun_ = true;
        open_ = model_.places[i].next;
    }
    [[nodiscard]] bool may_end() const { return begun_ ? model_.last.contains(at_) : model_.may_be_empty; }

    const ContentModel& model_;
    std::set<std::size_t> open_;  ///< places that may come now
    std::set<std::string> seen_;
    std::size_t at_ = 0;
    bool begun_ = false;
};

class Structure {
public:
    Structure(std::string file, int version) : file_(std::move(file)), version_(version), types_(types_of(version)) {}

    void check(const XmlElement& e, const std::string& type, bool list);
    std::vector<gum::Diagnostic> found;

private:
    void report(const char* code, const XmlElement& at, std::string what, std::string rule, std::string action) {
        if (found.size() < k_most_breaches) {
            found.push_back({.code = code,
                             .where = place_of(at, file_),
                             .what = std::move(what),
                             .rule = std::move(rule),
                             .action = std::move(action)});
        }
    }
    void attributes(const XmlElement& e, const std::vector<ElementType::Attribute>& known);
    void text(const XmlElement& e, const std::string& type, bool list, const std::vector<std::string>& words);
    void text_between(const XmlElement& e);
    void children(const XmlElement& e, const ContentModel& model);
    const ContentModel::Place* place_of_child(const XmlElement& e, const XmlElement& child, Walk& walk,
                                              std::set<std::string>& told);
    void foreign(const XmlElement& e, bool own_elements);

    std::string file_;
    int version_;
    const ElementTypes& types_;
};

void Structure::check(const XmlElement& e, const std::string& type, bool list) {
    if (type == "anything" || type == "foreign") {
        if (e.name.starts_with("dcc:")) {
            static const std::vector<ElementType::Attribute> k_of_foreign{
                {.name = "id"}, {.name = "refId"}, {.name = "refType"}};
            attributes(e, type == "foreign" ? k_of_foreign : std::vector<ElementType::Attribute>());
            text_between(e);
        }
        foreign(e, type == "anything");
        return;
    }
    const auto found_type = types_.find(type);
    static const ElementType k_plain;
    const ElementType& known = found_type == types_.end() || list ? k_plain : found_type->second;
    attributes(e, known.attributes);
    if (known.children) {
        children(e, *known.children);
    } else {
        text(e, type, list, found_type == types_.end() ? std::vector<std::string>() : found_type->second.words);
    }
}

/// Elements of other formats are left alone; those of the DCC and of D-SI that stand on their own are looked into.
void Structure::foreign(const XmlElement& e, bool own_elements) {
    if (e.name.starts_with("ds:")) {
        return;
    }
    for (const XmlElement& child : e.children) {
        if (!own_elements && child.name.starts_with("dcc:")) {
            report("GC-DCC-0113", child, short_name(child.name) + " in " + short_name(e.name),
                   "elements of another format than the DCC stand there", "leave it out");
        } else if (child.name.starts_with("si:") && types_.contains("si." + child.name.substr(3))) {
            check(child, "si." + child.name.substr(3), false);
        } else if (child.name == "dcc:digitalCalibrationCertificate") {
            check(child, "certificate", false);
        } else {
            foreign(child, own_elements);
        }
    }
}

std::string type_of_attribute(const std::string& name) {
    return name == "id"        ? "name"
           : name == "refId"   ? "names"
           : name == "refType" ? "references"
           : name == "lang"    ? "language"
                               : "string";
}

void Structure::attributes(const XmlElement& e, const std::vector<ElementType::Attribute>& known) {
    constexpr std::string_view k_instance = "{http://www.w3.org/2001/XMLSchema-instance}";
    for (const auto& [name, value] : e.attributes) {
        if (name.starts_with(k_instance)) {
            continue;  // where a schema lies
        }
        const bool is_known = std::any_of(known.begin(), known.end(),
                                          [&name = name](const ElementType::Attribute& a) { return a.name == name; });
        const std::string fault = is_known ? text_fault(type_of_attribute(name), value, version_) : "";
        if (!is_known) {
            report("GC-DCC-0114", e, "the attribute " + short_name(name) + " of " + short_name(e.name),
                   "the schema has no such attribute there", "leave it out, or correct its name");
        } else if (!fault.empty()) {
            report("GC-DCC-0114", e,
                   "the attribute " + name + " of " + short_name(e.name) + " is \"" +
                       shortened(printable(value), k_shown) + '"',
                   "the schema asks for " + fault, "correct it");
        }
    }
    for (const ElementType::Attribute& attribute : known) {
        const bool stated = std::any_of(e.attributes.begin(), e.attributes.end(),
                                        [&](const auto& a) { return a.first == attribute.name; });
        if (attribute.required && !stated) {
            report("GC-DCC-0114", e, "no attribute " + attribute.name + " of " + short_name(e.name),
                   "the schema demands it", "add it");
        }
    }
}

void Structure::text(const XmlElement& e, const std::string& type, bool list, const std::vector<std::string>& words) {
    for (const XmlElement& child : e.children) {
        report("GC-DCC-0113", child, short_name(child.name) + " in " + short_name(e.name),
               "the schema has a text there, and no elements", "leave it out");
    }
    for (const std::string& entry : list ? xml_list(e.text) : std::vector<std::string>{e.text}) {
        const bool one_of = words.empty() || std::find(words.begin(), words.end(), entry) != words.end();
        const std::string fault = one_of ? text_fault(type, entry, version_) : choice_of({words.begin(), words.end()});
        if (!fault.empty()) {
            report("GC-DCC-0115", e, short_name(e.name) + " is \"" + shortened(printable(entry), k_shown) + '"',
                   "the schema asks for " + fault, "correct it");
            return;
        }
    }
}

void Structure::text_between(const XmlElement& e) {
    if (!without_outer_blanks(e.text).empty()) {
        report("GC-DCC-0115", e,
               "\"" + shortened(printable(without_outer_blanks(e.text)), k_shown) +
                   "\" stands between the elements of " + short_name(e.name),
               "the schema has elements there, and no text", "leave it out");
    }
}

void Structure::children(const XmlElement& e, const ContentModel& model) {
    text_between(e);
    Walk walk(model);
    std::set<std::string> told;
    for (const XmlElement& child : e.children) {
        if (const ContentModel::Place* const place = place_of_child(e, child, walk, told)) {
            check(child, place->type, place->list);
        }
    }
    std::set<std::string> missing = walk.missing();
    const bool known =
        std::any_of(missing.begin(), missing.end(), [&](const auto& name) { return told.contains(name); });
    if (missing.empty() || known) {
        return;
    }
    const bool all = model.any_order;
    for (const std::string& name : all ? missing : std::set<std::string>{choice_of(missing)}) {
        report("GC-DCC-0112", e, "no " + name + " in " + short_name(e.name), "the schema of the DCC demands it",
               "add it; the order counts");
    }
}

/// The place that a child has in the model, and the words where it stands wrongly.
/// \param told  names that were reported already
const ContentModel::Place* Structure::place_of_child(const XmlElement& e, const XmlElement& child, Walk& walk,
                                                     std::set<std::string>& told) {
    if (const ContentModel::Place* const place = walk.step(child.name)) {
        return place;
    }
    const std::string name = short_name(child.name);
    const ContentModel::Place* const anywhere = walk.any_place(child.name);
    if (anywhere == nullptr) {
        report("GC-DCC-0113", child, name + " in " + short_name(e.name), "the schema has no such element there",
               "leave it out, or correct its name");
        return nullptr;
    }
    const std::set<std::string> missing = walk.missing();
    const std::set<std::string> possible = walk.possible();
    const ContentModel::Place* const later = walk.leap(child.name);
    // What seems to be missing may stand further behind: then the order is wrong, and nothing is to be added.
    const bool stands_later = std::any_of(e.children.begin(), e.children.end(), [&](const XmlElement& other) {
        return missing.contains(short_name(other.name));
    });
    if (later != nullptr && !missing.empty() && !stands_later) {
        report("GC-DCC-0112", child, "no " + choice_of(missing) + " in " + short_name(e.name) + " before " + name,
               "the schema of the DCC demands it", "add it; the order counts");
        return later;
    }
    // A second element at the wrong place follows from the first one in most cases.
    if (told.empty()) {
        report("GC-DCC-0113", child, name + " in " + short_name(e.name) + " stands at the wrong place, or too often",
               possible.empty() ? "nothing more may stand there" : choice_of(possible) + " may stand there",
               "the order of the elements counts");
    }
    told.insert(missing.begin(), missing.end());
    told.insert(name);
    return later != nullptr ? later : anywhere;
}

}  // namespace

std::vector<gum::Diagnostic> schema_breaches(const XmlElement& root, const std::string& file) {
    const int version = version_of(root.attribute("schemaVersion"));
    if (version < k_first_version) {
        return {};
    }
    Structure structure(file, version);
    structure.check(root, "certificate", false);
    return std::move(structure.found);
}

}  // namespace gumcert::reports
