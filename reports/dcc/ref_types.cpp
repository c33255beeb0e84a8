#include "reports/dcc/ref_types.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "gum/quantity/diagnostic.h"
#include "json/strict_parser.h"
#include "reports/dcc/xml_document.h"
#include "reports/forms/asset_files.h"
#include "text/place.h"

namespace gumcert::reports {

namespace {

[[noreturn]] void refuse(const std::string& where, const std::string& what) {
    throw gum::StorageError(
        gum::Diagnostic{.code = "GC-DCC-0201",
                        .where = where,
                        .what = what,
                        .rule = "the file has `definitions` with namespace, name and link, and `names`; "
                                "every prefix is defined",
                        .action = "take the file of this release, or correct it"});
}

std::string text_of(const nlohmann::json& object, const char* key, const std::string& where) {
    const auto found = object.is_object() ? object.find(key) : object.end();
    if (!object.is_object() || found == object.end() || !found->is_string() || found->get<std::string>().empty()) {
        refuse(where, std::string("no text `") + key + "`");
    }
    return found->get<std::string>();
}

}  // namespace

RefTypes RefTypes::read(const RenderAssets& assets) {
    const std::filesystem::path file = assets.templates / "dcc" / "ref_types.json";
    const std::string where = file.string();
    const std::optional<nlohmann::json> read = gumcert::json::parse(
        read_asset(file), {.byte_order_mark = true}, [&](const gumcert::json::ParsingProblem& problem) {
            refuse(where + " (" + text::line_and_column(problem.place) + ")", problem.what);
        });
    const nlohmann::json json = read.value_or(nullptr);
    if (!json.is_object() || !json.contains("definitions") || !json["definitions"].is_array() ||
        !json.contains("names") || !json["names"].is_object()) {
        refuse(where, "not an object with `definitions` and `names`");
    }
    RefTypes out;
    for (const nlohmann::json& definition : json["definitions"]) {
        out.definitions_.push_back({.space = text_of(definition, "namespace", where),
                                    .name = text_of(definition, "name", where),
                                    .link = text_of(definition, "link", where)});
    }
    for (const auto& [word, names] : json["names"].items()) {
        const std::string text = names.is_string() ? names.get<std::string>() : "";
        for (const std::string& name : xml_list(text)) {
            const std::string space = name.substr(0, name.find('_'));
            if (std::none_of(out.definitions_.begin(), out.definitions_.end(),
                             [&](const Definition& d) { return d.space == space; })) {
                refuse(where + "#/names/" + word, "the prefix of `" + name + "` is not defined");
            }
        }
        out.names_.emplace_back(word, text);
    }
    return out;
}

std::string RefTypes::operator()(const std::string& word) const {
    const auto found = std::find_if(names_.begin(), names_.end(), [&](const auto& name) { return name.first == word; });
    return found == names_.end() ? "" : found->second;
}

}  // namespace gumcert::reports
