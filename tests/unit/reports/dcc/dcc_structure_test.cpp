#include "reports/dcc/dcc_structure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <random>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "reports/dcc/content_model.h"
#include "reports/dcc/dcc_element.h"
#include "reports/dcc/dcc_schema_facts.h"
#include "tests/unit/reports/dcc/dcc_samples.h"

namespace gumcert::reports {
namespace {

constexpr std::array<const char*, 4> k_versions{"3.1.1", "3.1.2", "3.2.1", "3.3.0"};

int number_of(const std::string& version) {
    return 100 * (version[0] - '0') + 10 * (version[2] - '0') + (version[4] - '0');
}

std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
        out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '"' ? "&quot;" : std::string(1, c);
    }
    return out;
}

void write(const XmlElement& e, bool root, std::string& out) {
    out += "<" + e.name;
    out += root ? " xmlns:dcc=\"https://ptb.de/dcc\" xmlns:si=\"https://ptb.de/si\"" : "";
    for (const auto& [name, value] : e.attributes) {
        out += " " + name + "=\"" + escaped(value) + "\"";
    }
    out += ">" + escaped(e.text);
    for (const XmlElement& child : e.children) {
        write(child, false, out);
    }
    out += "</" + e.name + ">";
}

std::string document(const XmlElement& root) {
    std::string out;
    write(root, true, out);
    return out + "\n";
}

using Random = std::mt19937;

std::size_t below(std::size_t count, Random& random) {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(random);
}

bool with_chance(double chance, Random& random) {
    return std::uniform_real_distribution<double>(0.0, 1.0)(random) < chance;
}

/// Documents that the facts allow, at random.
class Maker {
public:
    Maker(const std::string& version, Random& random)
        : version_(version), types_(element_types(dcc_schema_facts(), number_of(version))), random_(random) {}

    XmlElement certificate() {
        elements_ = 0;
        XmlElement root = element("dcc:digitalCalibrationCertificate", "certificate", false, 0);
        root.attributes = {{"schemaVersion", version_}};
        std::erase_if(root.children, [](const XmlElement& child) { return child.name == "ds:Signature"; });
        return root;
    }

private:
    std::string text(const std::string& type) {
        static const std::map<std::string, std::vector<std::string>> k_texts = {
            {"string", {"x", "a b"}},
            {"word", {"x", "a b"}},
            {"country", {"DE", "TW"}},
            {"language", {"de", "en"}},
            {"date", {"2026-11-22", "2026-11-22Z", "0001-01-01", "2026-11-22+01:00"}},
            {"dateTime", {"2026-11-22T12:00:00", "2026-11-22T12:00:00.5Z"}},
            {"duration", {"P1Y", "PT0.5S", "-P1Y2M3DT4H5M6S"}},
            {"boolean", {"true", "0"}},
            {"uri", {"https://example.org/a?b#c", "urn:x:y", "a/b"}},
            {"base64", {"QUJD", "QQ=="}},
            {"integer", {"2", "-3"}},
            {"decimal", {"1.5", "-2.", "+.5e-3", "7E+2"}},
            {"positive", {"1.5", "0", "+.5e-3"}},
            {"factor", {"2", "1.96", "+14."}},
            {"probability", {"0.95", "1.0", "0"}}};
        const auto found = k_texts.find(type);
        return found == k_texts.end() ? "x" : found->second[below(found->second.size(), random_)];
    }
    void attributes(const ElementType& type, XmlElement& e) {
        for (const ElementType::Attribute& a : type.attributes) {
            if (a.name == "id" && with_chance(0.2, random_)) {
                e.attributes.emplace_back("id", "id" + std::to_string(++ids_));
            } else if (a.name == "refType" && with_chance(0.2, random_)) {
                e.attributes.emplace_back("refType", "basic_a basic_b");
            } else if (a.name == "lang" && with_chance(0.5, random_)) {
                e.attributes.emplace_back("lang", "en");
            }
        }
    }
    void children(const ContentModel& model, std::size_t depth, XmlElement& e) {
        if (model.any_order) {
            for (const ContentModel::Place& place : model.places) {
                if (place.required || with_chance(0.5, random_)) {
                    e.children.push_back(element(place.element, place.type, place.list, depth + 1));
                }
            }
            std::shuffle(e.children.begin(), e.children.end(), random_);
            return;
        }
        std::set<std::size_t> open = model.first;
        std::set<std::size_t> seen;
        bool may_end = model.may_be_empty;
        constexpr std::size_t k_deep = 9;
        constexpr std::size_t k_many = 300;
        const bool enough = depth > k_deep || elements_ > k_many;
        while (!open.empty() && !(may_end && with_chance(enough ? 1.0 : 0.2, random_))) {
            const std::size_t i =
                enough ? shortest(model, open, seen)
                       : *std::next(open.begin(), static_cast<std::ptrdiff_t>(below(open.size(), random_)));
            e.children.push_back(
                element(model.places[i].element, model.places[i].type, model.places[i].list, depth + 1));
            seen.insert(i);
            open = model.places[i].next;
            may_end = model.last.contains(i);
        }
    }
    /// How deep a type is at least: 0 for a text.
    int depth_of(const std::string& type, int most = 12) {
        const auto found = types_.find(type);
        if (found == types_.end() || !found->second.children || most == 0) {
            return most == 0 ? 100 : 0;
        }
        if (const auto known = depths_.find(type); known != depths_.end()) {
            return known->second;
        }
        int least = 100;
        int needed = 0;
        for (const ContentModel::Place& place : found->second.children->places) {
            const int depth = 1 + depth_of(place.type, most - 1);
            needed = place.required ? std::max(needed, depth) : needed;
            least = std::min(least, depth);
        }
        return depths_[type] = std::max(needed, found->second.children->may_be_empty ? 0 : least);
    }
    /// The place that leads to the end in the shortest way.
    std::size_t shortest(const ContentModel& model, const std::set<std::size_t>& open,
                         const std::set<std::size_t>& seen) {
        return *std::min_element(open.begin(), open.end(), [&](std::size_t a, std::size_t b) {
            const auto rank = [&](std::size_t i) {
                return std::tuple(seen.contains(i), !model.places[i].required, depth_of(model.places[i].type));
            };
            return rank(a) < rank(b);
        });
    }
    XmlElement element(const std::string& name, const std::string& type, bool list, std::size_t depth) {
        XmlElement e;
        e.name = name;
        ++elements_;
        const auto found = types_.find(type);
        if (found != types_.end() && !list) {
            attributes(found->second, e);
        }
        if (name == "ds:Signature" || type == "anything" || type == "foreign") {
            return e;
        }
        if (found != types_.end() && found->second.children) {
            children(*found->second.children, depth, e);
            return e;
        }
        const std::vector<std::string> words = found == types_.end() ? std::vector<std::string>() : found->second.words;
        for (int i = 0; i < (list ? 2 : 1); ++i) {
            e.text += (i > 0 ? " " : "") + (words.empty() ? text(type) : words[below(words.size(), random_)]);
        }
        return e;
    }

    std::string version_;
    ElementTypes types_;
    Random& random_;
    int ids_ = 0;
    std::size_t elements_ = 0;
    std::map<std::string, int> depths_;
};

/// Without signatures, and without elements and attributes of other formats.
void without_foreign_parts(XmlElement& e) {
    std::erase_if(e.children, [](const XmlElement& child) { return child.name.starts_with("ds:"); });
    std::erase_if(e.attributes, [](const auto& a) { return a.first.starts_with("{"); });
    if (!e.children.empty()) {
        e.text.clear();
    }
    if (e.name == "dcc:comment") {
        e.children.clear();  // elements of other formats
    }
    for (XmlElement& child : e.children) {
        without_foreign_parts(child);
    }
}

void collect(XmlElement& e, std::vector<XmlElement*>& all) {
    all.push_back(&e);
    if (e.name == "dcc:comment" || e.name == "dcc:xml" || e.name == "dcc:mathml") {
        return;  // what is foreign
    }
    for (XmlElement& child : e.children) {
        collect(child, all);
    }
}

constexpr std::array k_bad_texts{
    "",     " ",    "x",   "pass",         "Pass",       " pass",      "PASS",
    "NaN",  "-1",   "1e5", "0.5",          "2.0",        "INF",        "1,5",
    "de",   "DE",   "deu", "2026-02-30",   "true",       "TRUE",       "1.1",
    "0,95", "95",   "00",  "2026-11-22",   "22.11.2026", "laboratory", "Lab",
    "a  b", "a b ", "::x", "%zz",          "QQ",         "P",          "2026-11-22T25:00:00",
    "-0.1", "+3",   "3.",  "manufacturer", "\\metre"};

/// One change somewhere; what it was, in words.
std::string changed(XmlElement& root, const std::vector<std::string>& vocabulary, Random& random) {
    std::vector<XmlElement*> all;
    collect(root, all);
    XmlElement& e = *all[below(all.size(), random)];
    const auto with_children = [&](std::size_t least) -> XmlElement* {
        std::vector<XmlElement*> fit;
        std::copy_if(all.begin(), all.end(), std::back_inserter(fit), [&](const XmlElement* one) {
            return one->children.size() >= least && one->name != "dcc:comment" && one->name != "dcc:xml";
        });
        return fit.empty() ? nullptr : fit[below(fit.size(), random)];
    };
    constexpr std::size_t k_kinds = 12;
    switch (below(k_kinds, random)) {
        case 0: {
            XmlElement& p = *with_children(1);
            const std::size_t i = below(p.children.size(), random);
            const std::string name = p.children[i].name;
            p.children.erase(p.children.begin() + static_cast<std::ptrdiff_t>(i));
            return "without " + name + " in " + p.name;
        }
        case 1: {
            XmlElement& p = *with_children(1);
            const XmlElement copy = p.children[below(p.children.size(), random)];
            p.children.insert(p.children.begin() + static_cast<std::ptrdiff_t>(below(p.children.size() + 1, random)),
                              copy);
            return "doubled " + copy.name + " in " + p.name;
        }
        case 2: {
            XmlElement* const p = with_children(2);
            if (p == nullptr) {
                return "nothing";
            }
            const std::size_t i = below(p->children.size() - 1, random);
            std::swap(p->children[i], p->children[i + 1]);
            return "swapped " + p->children[i].name + " in " + p->name;
        }
        case 3: {
            XmlElement* const p = with_children(2);
            if (p == nullptr) {
                return "nothing";
            }
            std::shuffle(p->children.begin(), p->children.end(), random);
            return "shuffled " + p->name;
        }
        case 4:
            e.name += "x";
            return "renamed to " + e.name;
        case 5: {
            const std::string old = std::exchange(e.name, vocabulary[below(vocabulary.size(), random)]);
            return "renamed " + old + " to " + e.name;
        }
        case 6: {
            XmlElement added;
            added.name = vocabulary[below(vocabulary.size(), random)];
            e.children.insert(e.children.begin() + static_cast<std::ptrdiff_t>(below(e.children.size() + 1, random)),
                              added);
            return "added " + added.name + " in " + e.name;
        }
        case 7: {
            static constexpr std::array k_names{"id", "refId", "refType", "lang", "xml:lang", "unit", "schemaVersion"};
            const std::string name = k_names[below(k_names.size(), random)];
            std::erase_if(e.attributes, [&](const auto& a) { return a.first == name && name != "schemaVersion"; });
            const bool twice =
                std::any_of(e.attributes.begin(), e.attributes.end(), [&](const auto& a) { return a.first == name; });
            const std::string value = with_chance(0.5, random) ? "en" : with_chance(0.5, random) ? "1x" : "";
            if (!twice) {
                e.attributes.emplace_back(name, value);
            }
            return "attribute " + name + "=\"" + value + "\" of " + e.name;
        }
        case 8:
            if (!e.attributes.empty()) {
                e.attributes.back().first += "X";
            }
            return "attribute renamed of " + e.name;
        case 9:
        case 10: {
            std::vector<XmlElement*> leaves;
            std::copy_if(all.begin(), all.end(), std::back_inserter(leaves),
                         [](const XmlElement* one) { return one->children.empty() && one->name != "dcc:comment"; });
            XmlElement& leaf = *leaves[below(leaves.size(), random)];
            leaf.text = k_bad_texts[below(k_bad_texts.size(), random)];
            return leaf.name + " = \"" + leaf.text + "\"";
        }
        default:
            e.text += with_chance(0.5, random) ? "text" : "\n  ";
            return "text in " + e.name;
    }
}

struct Tally {
    std::size_t refused = 0, told = 0, false_alarms = 0, valid = 0;
    std::vector<std::string> silent, alarms;
};

bool is_told(const std::string& text) {
    try {
        for (const auto& found : {check_dcc_structure(text, "a.xml"), check_dcc(text, "a.xml")}) {
            if (std::any_of(found.begin(), found.end(),
                            [](const gum::Diagnostic& d) { return d.severity == gum::Severity::error; })) {
                return true;
            }
        }
        return false;
    } catch (const gum::InputError&) {
        return true;
    }
}

/// libxml2 accepts two things that the standard of schemas refuses: other characters in base64, an empty list IDREFS.
bool is_left_by_libxml2(const gum::Diagnostic& d) {
    return d.rule == "the schema asks for bytes in base64" || d.what.starts_with("the attribute refId");
}

void compare(const std::string& text, const std::string& version, const std::string& what, Tally& tally) {
    const std::string schema = test::schema_errors(text, version);
    constexpr std::size_t k_listed = 20;
    if (!schema.empty()) {
        ++tally.refused;
        tally.told += is_told(text) ? 1U : 0U;
        if (!is_told(text) && tally.silent.size() < k_listed) {
            tally.silent.push_back(version + " " + what + ": " + schema.substr(0, 300));
        }
        return;
    }
    ++tally.valid;
    std::vector<gum::Diagnostic> found;
    try {
        found = check_dcc_structure(text, "a.xml");
    } catch (const gum::InputError& refused) {
        found = refused.diagnostics();
    }
    std::erase_if(found, is_left_by_libxml2);
    tally.false_alarms += found.empty() ? 0U : 1U;
    if (!found.empty() && tally.alarms.size() < k_listed) {
        tally.alarms.push_back(version + " " + what + ": " + gum::message(found.front()));
    }
}

std::vector<std::string> vocabulary_of(const std::string& version) {
    std::set<std::string> names;
    for (const auto& [name, type] : element_types(dcc_schema_facts(), number_of(version))) {
        for (const ContentModel::Place& place :
             type.children ? type.children->places : std::vector<ContentModel::Place>()) {
            names.insert(place.element);
        }
    }
    names.erase("ds:Signature");
    return {names.begin(), names.end()};
}

std::vector<std::pair<std::string, XmlElement>> published_and_own() {
    std::vector<std::pair<std::string, std::string>> texts;
    for (const auto& entry : std::filesystem::directory_iterator(test::shared_dcc() / "examples")) {
        if (entry.path().extension() == ".xml") {
            texts.emplace_back(entry.path().filename().string(), test::content_of(entry.path()));
        }
    }
    texts.emplace_back("worked", test::content_of(test::shared_dcc() / "worked-example-3.3.0.xml"));
    texts.emplace_back("budget", render_dcc(test::certified_budget(), test::dcc_assets({"en", "de"})));
    texts.emplace_back("rotary table", render_dcc(test::certified_rotary_table(), test::dcc_assets()));
    std::vector<std::pair<std::string, XmlElement>> all;
    for (const auto& [name, text] : texts) {
        XmlElement root = read_dcc_root(text, name);
        without_foreign_parts(root);
        if (root.attribute("schemaVersion") == "3.2.0") {  // its schema is not there; it is of 3.2.1 as well
            root.attributes = {{"schemaVersion", "3.2.1"}};
        }
        all.emplace_back(name, std::move(root));
    }
    return all;
}

void expect_agreement(const Tally& tally) {
    EXPECT_EQ(tally.false_alarms, 0U);
    EXPECT_GE(static_cast<double>(tally.told), 0.95 * static_cast<double>(tally.refused));
    for (const std::string& one : tally.alarms) {
        ADD_FAILURE() << "false alarm: " << one;
    }
    for (const std::string& one : tally.silent) {
        std::cout << "not told: " << one << "\n";
    }
    std::cout << tally.refused << " refused by the schema, " << tally.told << " of them told; " << tally.valid
              << " valid, " << tally.false_alarms << " false alarms\n";
}

// The facts against the schema: what they allow, it accepts; what it refuses, they refuse.
TEST(DccStructure, DocumentsMadeFromTheFactsAreThoseOfTheSchema) {
    if (!std::filesystem::exists(test::shared_dcc())) {
        GTEST_SKIP() << "the folder of schemas is not there";
    }
    Random random(20261122);
    Tally changes;
    for (const std::string version : k_versions) {
        const std::vector<std::string> vocabulary = vocabulary_of(version);
        Maker maker(version, random);
        for (int i = 0; i < 40; ++i) {
            const XmlElement made = maker.certificate();
            const std::string text = document(made);
            EXPECT_EQ(test::schema_errors(text, version).substr(0, 300), "") << version << "\n" << text.substr(0, 3000);
            const auto found = check_dcc_structure(text, "a.xml");
            EXPECT_TRUE(found.empty()) << version << " " << gum::message(found.front());
            for (int change = 0; change < 12; ++change) {
                XmlElement copy = made;
                const std::string what = changed(copy, vocabulary, random);
                compare(document(copy), version, what, changes);
            }
        }
    }
    EXPECT_GT(changes.refused, 1000U);
    expect_agreement(changes);
}

TEST(DccStructure, WhatTheSchemaRefusesInRealCertificatesIsTold) {
    if (!std::filesystem::exists(test::shared_dcc())) {
        GTEST_SKIP() << "the folder of schemas is not there";
    }
    Random random(3);
    Tally changes;
    for (const auto& [name, root] : published_and_own()) {
        for (const std::string version : k_versions) {
            XmlElement other = root;
            other.attributes = {{"schemaVersion", version}};
            compare(document(other), version, name + " as " + version, changes);
        }
        const std::string version = root.attribute("schemaVersion");
        EXPECT_EQ(test::schema_errors(document(root), version), "") << name;
        const std::vector<std::string> vocabulary = vocabulary_of(version);
        for (int change = 0; change < 150; ++change) {
            XmlElement copy = root;
            const std::string what = changed(copy, vocabulary, random);
            compare(document(copy), version, name + ": " + what, changes);
        }
    }
    EXPECT_GT(changes.refused, 500U);
    expect_agreement(changes);
}

}  // namespace
}  // namespace gumcert::reports
