#include "workbook/workbook_parts.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <set>
#include <utility>

#include "text/visible_text.h"
#include "workbook/letters.h"
#include "workbook/limits.h"
#include "workbook/xml_events.h"

namespace gumcert::workbook {

namespace {

/// A number without a sign; the largest one where the text is none, so that no table holds it.
std::size_t place_of(std::string_view text) {
    std::size_t value = 0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
    return failure == std::errc() && end == text.data() + text.size() && !text.empty()
               ? value
               : std::numeric_limits<std::size_t>::max();
}

class RelationshipReader final : public XmlHandler {
public:
    explicit RelationshipReader(std::string where) : where_(std::move(where)) {}
    std::map<std::string, Relationship> found;

    void start(std::string_view name, const XmlAttributes& attributes) override {
        if (name != "Relationship") {
            return;
        }
        const std::string& type = attributes.value("Type");
        const std::size_t slash = type.rfind('/');
        const Relationship one{.type = slash == std::string::npos ? type : type.substr(slash + 1),
                               .target = attributes.value("Target"),
                               .is_external = attributes.value("TargetMode") == "External"};
        if (found.size() >= k_most_parts) {
            throw too_many(where_, "more than 10000 relationships");
        }
        if (!found.emplace(attributes.value("Id"), one).second) {
            throw bad_content(where_, "two relationships of the id " + text::in_quotes(attributes.value("Id")));
        }
    }
    void end(std::string_view) override {}
    void text(std::string_view) override {}

private:
    std::string where_;
};

class WorkbookReader final : public XmlHandler {
public:
    WorkbookReader(std::string where, TextAllowance& texts) : where_(std::move(where)), texts_(texts) {}
    WorkbookPart part;

    void start(std::string_view name, const XmlAttributes& attributes) override {
        if (name == "sheet" && is_in("sheets")) {
            sheet(attributes);
        } else if (name == "definedName" && is_in("definedNames")) {
            defined_name(attributes);
        } else if (name == "externalReference" && is_in("externalReferences")) {
            if (part.external_links.size() >= k_most_parts) {
                throw too_many(where_, "more than 10000 links to other files");
            }
            part.external_links.push_back(attributes.value("id"));
        } else if (name == "workbookProtection") {
            part.structure_is_protected = attributes.is_true("lockStructure");
        } else if (name == "workbookPr") {
            part.dates_from_1904 = attributes.is_true("date1904");
        } else if (name == "calcPr") {
            const std::string& full = attributes.value("fullPrecision");
            part.precision_as_displayed = full == "0" || full == "false";
            part.iterates = attributes.is_true("iterate");
        }
    }

    void end(std::string_view name) override {
        if (name == "definedName" && is_in("definedNames")) {
            const DefinedName& one = part.defined_names.back();
            const std::string key = (one.sheet ? std::to_string(*one.sheet) : "") + "!" + folded_text(one.name);
            if (!names_.insert(key).second) {
                throw bad_content(where_, "two definitions of the name " + text::in_quotes(one.name));
            }
        }
    }

    void text(std::string_view characters) override {
        if (!path.empty() && path.back() == "definedName" && is_in("definedNames")) {
            texts_.take(characters.size(), where_);
            part.defined_names.back().formula += characters;
        }
    }

private:
    void sheet(const XmlAttributes& attributes) {
        if (part.sheets.size() >= k_most_sheets) {
            throw too_many(where_, "more than 1000 sheets");
        }
        const std::string& state = attributes.value("state");
        part.sheets.push_back({.name = attributes.value("name"),
                               .state = state == "hidden"       ? SheetState::hidden
                                        : state == "veryHidden" ? SheetState::very_hidden
                                                                : SheetState::visible,
                               .relationship = attributes.value("id")});
        if (part.sheets.back().name.empty() || !sheets_.insert(folded_text(part.sheets.back().name)).second) {
            throw bad_content(where_, "a second sheet of the name " + text::in_quotes(part.sheets.back().name));
        }
    }

    void defined_name(const XmlAttributes& attributes) {
        if (part.defined_names.size() >= k_most_names) {
            throw too_many(where_, "more than 100000 defined names");
        }
        DefinedName one{
            .name = attributes.value("name"), .formula = "", .sheet = {}, .is_hidden = attributes.is_true("hidden")};
        texts_.take(one.name.size(), where_);
        if (const std::string& sheet = attributes.value("localSheetId"); !sheet.empty()) {
            one.sheet = place_of(sheet);
            if (*one.sheet >= k_most_sheets) {
                throw bad_content(where_, "the name " + text::in_quotes(one.name) + " of a sheet that there is not");
            }
        }
        part.defined_names.push_back(std::move(one));
    }

    std::string where_;
    TextAllowance& texts_;
    std::set<std::string> sheets_, names_;
};

class StringsReader final : public XmlHandler {
public:
    explicit StringsReader(std::string where) : where_(std::move(where)) {}
    std::vector<std::string> strings;

    void start(std::string_view name, const XmlAttributes&) override {
        if (name == "si" && is_in("sst")) {
            if (strings.size() >= k_most_cells) {
                throw too_many(where_, "more than 2 million shared texts");
            }
            strings.emplace_back();
        }
    }
    void end(std::string_view) override {}
    void text(std::string_view characters) override {
        // Text as it is shown, in one piece or in runs; how East Asian words are spoken (rPh) is left out.
        if (!path.empty() && path.back() == "t" && (is_in("si") || is_in("r")) && !strings.empty()) {
            strings.back() += characters;
        }
    }

private:
    std::string where_;
};

/// ECMA-376 Part 1, 18.8.30: what stands for the numbers of formats that a file does not define.
constexpr std::array<std::pair<std::size_t, std::string_view>, 28> k_built_in_formats{{{1, "0"},
                                                                                       {2, "0.00"},
                                                                                       {3, "#,##0"},
                                                                                       {4, "#,##0.00"},
                                                                                       {9, "0%"},
                                                                                       {10, "0.00%"},
                                                                                       {11, "0.00E+00"},
                                                                                       {12, "# ?/?"},
                                                                                       {13,
                                                                                        "# ?"
                                                                                        "?/?"
                                                                                        "?"},
                                                                                       {14, "mm-dd-yy"},
                                                                                       {15, "d-mmm-yy"},
                                                                                       {16, "d-mmm"},
                                                                                       {17, "mmm-yy"},
                                                                                       {18, "h:mm AM/PM"},
                                                                                       {19, "h:mm:ss AM/PM"},
                                                                                       {20, "h:mm"},
                                                                                       {21, "h:mm:ss"},
                                                                                       {22, "m/d/yy h:mm"},
                                                                                       {37, "#,##0 ;(#,##0)"},
                                                                                       {38, "#,##0 ;[Red](#,##0)"},
                                                                                       {39, "#,##0.00;(#,##0.00)"},
                                                                                       {40, "#,##0.00;[Red](#,##0.00)"},
                                                                                       {45, "mm:ss"},
                                                                                       {46, "[h]:mm:ss"},
                                                                                       {47, "mmss.0"},
                                                                                       {48, "##0.0E+0"},
                                                                                       {49, "@"},
                                                                                       {0, "General"}}};

class StylesReader final : public XmlHandler {
public:
    StylesReader(std::string where, TextAllowance& texts) : where_(std::move(where)), texts_(texts) {
        places_.emplace("General", 0);
        for (const auto& [number, text] : k_built_in_formats) {
            codes_.emplace(number, text);
        }
    }
    NumberFormats formats;

    void start(std::string_view name, const XmlAttributes& attributes) override {
        if (name == "numFmt" && is_in("numFmts")) {
            texts_.take(attributes.value("formatCode").size(), where_);
            codes_[place_of(attributes.value("numFmtId"))] = attributes.value("formatCode");
        } else if (name == "xf" && is_in("cellXfs")) {
            const auto code = codes_.find(place_of(attributes.value("numFmtId")));
            const std::string text = code == codes_.end() ? "General" : code->second;
            const auto [place, is_new] = places_.emplace(text, static_cast<std::uint32_t>(formats.texts.size()));
            if (is_new) {
                formats.texts.push_back(text);
            }
            formats.of_style.push_back(place->second);
        }
        if (codes_.size() > k_most_formats || formats.of_style.size() > k_most_formats) {
            throw too_many(where_, "more than 100000 formats");
        }
    }
    void end(std::string_view) override {}
    void text(std::string_view) override {}

private:
    std::string where_;
    TextAllowance& texts_;
    std::map<std::size_t, std::string> codes_;
    std::map<std::string, std::uint32_t> places_;
};

class PropertiesReader final : public XmlHandler {
public:
    explicit PropertiesReader(WorkbookMetadata& metadata) : metadata_(metadata) {}

    void start(std::string_view, const XmlAttributes&) override {}
    void end(std::string_view) override {}
    void text(std::string_view characters) override {
        if (path.size() != 2) {
            return;
        }
        constexpr std::size_t k_longest = 200;
        for (const auto& [name, member] : {std::pair{"Application", &WorkbookMetadata::application},
                                           {"AppVersion", &WorkbookMetadata::application_version},
                                           {"created", &WorkbookMetadata::created},
                                           {"modified", &WorkbookMetadata::modified}}) {
            std::string& kept = metadata_.*member;
            if (path.back() == name && kept.size() + characters.size() <= k_longest) {
                kept += characters;
            }
        }
    }

private:
    WorkbookMetadata& metadata_;
};

class LinkReader final : public XmlHandler {
public:
    LinkPart part;

    void start(std::string_view name, const XmlAttributes& attributes) override {
        if (!is_in("externalLink") || !part.kind.empty()) {
            return;
        }
        if (name == "externalBook" || name == "oleLink") {
            part.kind = name == "oleLink" ? "ole" : "workbook";
            part.relationship = attributes.value("id");
        } else if (name == "ddeLink") {
            part.kind = "dde";
            part.target = attributes.value("ddeService") + "|" + attributes.value("ddeTopic");
        }
    }
    void end(std::string_view) override {}
    void text(std::string_view) override {}
};

}  // namespace

void TextAllowance::take(std::size_t bytes, const std::string& where) {
    if (bytes > left_) {
        throw gum::InputError(gum::Diagnostic{.code = "GC-WORKBOOK-0018",
                                              .where = where,
                                              .what = "cells with more than 200 MB of text",
                                              .rule = "texts and formulas of all cells are at most 200 MB together",
                                              .action = "store what is to be looked at as a workbook of its own"});
    }
    left_ -= bytes;
}

gum::InputError bad_content(const std::string& where, const std::string& what) {
    return gum::InputError(
        gum::Diagnostic{.code = "GC-WORKBOOK-0011",
                        .where = where,
                        .what = what,
                        .rule = "parts of a workbook say what ECMA-376 allows, and one thing once",
                        .action = "ask for an undamaged file, or store the workbook again with a spreadsheet program"});
}

gum::InputError too_many(const std::string& where, const std::string& what) {
    return gum::InputError(gum::Diagnostic{.code = "GC-WORKBOOK-0012",
                                           .where = where,
                                           .what = what,
                                           .rule = "workbooks are read up to 2 million cells and shared texts, 1000 "
                                                   "sheets, 100000 names and formats, and 10000 links",
                                           .action = "store what is to be looked at as a workbook of its own"});
}

std::map<std::string, Relationship> read_relationships(std::string_view xml, const std::string& where) {
    RelationshipReader reader(where);
    read_xml_events(xml, where, reader);
    return std::move(reader.found);
}

WorkbookPart read_workbook_part(std::string_view xml, const std::string& where, TextAllowance& texts) {
    WorkbookReader reader(where, texts);
    read_xml_events(xml, where, reader);
    for (const DefinedName& name : reader.part.defined_names) {
        if (name.sheet && *name.sheet >= reader.part.sheets.size()) {
            throw bad_content(where, "the name " + text::in_quotes(name.name) + " of a sheet that there is not");
        }
    }
    return std::move(reader.part);
}

std::vector<std::string> read_shared_strings(std::string_view xml, const std::string& where) {
    StringsReader reader(where);
    read_xml_events(xml, where, reader);
    return std::move(reader.strings);
}

NumberFormats read_number_formats(std::string_view xml, const std::string& where, TextAllowance& texts) {
    StylesReader reader(where, texts);
    read_xml_events(xml, where, reader);
    return std::move(reader.formats);
}

void read_properties(std::string_view xml, const std::string& where, WorkbookMetadata& metadata) {
    PropertiesReader reader(metadata);
    read_xml_events(xml, where, reader);
}

LinkPart read_link_part(std::string_view xml, const std::string& where) {
    LinkReader reader;
    read_xml_events(xml, where, reader);
    return std::move(reader.part);
}

}  // namespace gumcert::workbook
