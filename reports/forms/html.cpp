#include "encoding/base64.h"
#include "gum/quantity/diagnostic.h"
#include "reports/forms/asset_files.h"
#include "reports/forms/document_forms.h"
#include "reports/forms/pdf_page_texts.h"
#include "reports/forms/qr_code.h"
#include "reports/forms/render.h"
#include "reports/forms/typeset_drawing.h"
#include "reports/forms/typeset_html.h"
#include "reports/view/certificate_builder.h"
#include "reports/view/certificate_view.h"
#include "reports/wording.h"

#if defined(__GNUC__) && !defined(__clang__)
// The copy constructor of kainjow's data holds pointers of which one is set; g++ 12 sees the others as dereferenced.
#pragma GCC diagnostic ignored "-Wnull-dereference"
#endif
#include <kainjow/mustache.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gumcert::reports {

namespace {

using kainjow::mustache::data;

/// A view as the template engine takes it. Its set() and push_back() copy all that is below, at every level; parts are
/// moved into their places instead.
data to_mustache(const nlohmann::json& value) {
    if (value.is_object()) {
        data object{data::type::object};
        for (const auto& [key, item] : value.items()) {
            object[key] = to_mustache(item);
        }
        return object;
    }
    if (value.is_array()) {
        data list{data::type::list};
        for (std::size_t i = 0; i < value.size(); ++i) {
            list.push_back(data{data::type::invalid});
        }
        for (std::size_t i = 0; i < value.size(); ++i) {
            const_cast<data&>(list.list_value()[i]) = to_mustache(value[i]);  // `list` itself is not const
        }
        return list;
    }
    return data{value.get<std::string>()};
}

/// Pictures that a template of a laboratory names stand beside it; documents load nothing, so they are put into the file.
std::string with_pictures(const std::string& html, const RenderAssets& assets) {
    static constexpr std::string_view k_source = " src=\"";
    std::string out;
    std::size_t at = 0;
    for (std::size_t found = html.find(k_source); found != std::string::npos; found = html.find(k_source, at)) {
        const std::size_t from = found + k_source.size();
        const std::size_t end = std::min(html.find('"', from), html.size());
        const std::filesystem::path name = html.substr(from, end - from);
        const std::string type = name.extension() == ".png"                                  ? "png"
                                 : name.extension() == ".jpg" || name.extension() == ".jpeg" ? "jpeg"
                                                                                             : "";
        out += html.substr(at, from - at);
        out += type.empty() || name.has_parent_path()
                   ? name.string()
                   : "data:image/" + type + ";base64," + encoding::base64(read_asset(assets.templates / name));
        at = end;
    }
    return out + html.substr(at);
}

/// With the digest of templates that were changed in the foot of the pages.
nlohmann::json with_template_mark(nlohmann::json view, const Wording& words, const RenderAssets& assets) {
    view["changed_templates"] = nlohmann::json::array();
    if (!assets.changed_templates.empty()) {
        const std::string text =
            words.filled("document", "changed_templates", {{"digest", assets.changed_templates}}).first();
        view["changed_templates"].push_back({{"text", text}, {"digest", assets.changed_templates}});
        view["footer_left"] = view.at("footer_left").get<std::string>() + " · " + text;
    }
    return view;
}

/// With the head of an archive at its end, in words and as a QR code.
nlohmann::json with_head_of_archive(nlohmann::json view, const Wording& words, const RenderAssets& assets) {
    view["head_code"] = nlohmann::json::array();
    if (!assets.head) {
        return view;
    }
    constexpr double k_side = 84.0;  // pixels of 1/96 inch: 22 mm
    const HeadToPrint& head = *assets.head;
    const auto say = [&](const char* sentence, const Wording::Values& values) {
        const Text text = words.filled("document", sentence, values);
        view["closing"].push_back({{"text", text.first()}, {"also", also(text, words.languages())}});
    };
    say("archive_head", {{"entries", head.entries}, {"digits", head.digits}});
    if (!head.check_at.empty()) {
        say("archive_check", {{"where", head.check_at}});
    }
    view["head_code"].push_back({{"text", head.mark}, {"svg", svg_of(qr_code(head.mark), 0.0, 0.0, k_side)}});
    return view;
}

/// A page is one file that the browser breaks into pages: what each of them needs is in it, or there is no document.
void require_texts(const std::string& html, const nlohmann::json& view) {
    std::vector<gum::Diagnostic> missing;
    for (const std::string& text : texts_of_every_page(view)) {
        kainjow::mustache::mustache escaping{"{{text}}"};
        if (html.find(escaping.render(data{"text", text})) == std::string::npos) {
            missing.push_back(missing_on_a_page("HTML", text));
        }
    }
    if (!missing.empty()) {
        throw gum::NoResultError(std::move(missing));
    }
}

}  // namespace

std::string filled_template(const std::string& file, const nlohmann::json& view, const RenderAssets& assets) {
    const std::filesystem::path path = assets.templates / file;
    kainjow::mustache::mustache page{read_asset(path)};
    std::string html = page.is_valid() ? page.render(to_mustache(view)) : std::string();
    if (!page.is_valid()) {
        throw gum::StorageError(gum::Diagnostic{.code = "GC-REPORT-0001",
                                                .where = path.string(),
                                                .what = page.error_message(),
                                                .rule = "the template is Mustache",
                                                .action = "take the templates of this release"});
    }
    return html;
}

std::string view_as_html(nlohmann::json view, const RenderAssets& assets) {
    view = with_typeset_drawings(std::move(view));
    view["style"] = read_asset(assets.templates / "certificate.css");
    const std::string html = filled_template("certificate.html.mustache", view, assets);
    require_texts(html, view);
    return with_pictures(typeset_html(html, view), assets);
}

std::string document_as_html(const nlohmann::json& view, const RenderAssets& assets) {
    std::string html = view_as_html(view, assets);
    require_head(html, "HTML", assets);
    return html;
}

std::string render_html(const EvaluationRecord& record, const RenderAssets& assets) {
    return document_as_html(view_of_document(record, assets), assets);
}

void require_head(std::string_view document, const char* form, const RenderAssets& assets) {
    if (assets.head && document.find(assets.head->mark) == std::string_view::npos) {
        throw gum::NoResultError(missing_on_a_page(form, assets.head->mark));
    }
}

nlohmann::json view_of_document(const EvaluationRecord& record, const RenderAssets& assets) {
    const Wording words = read_wording(assets, record);
    return with_head_of_archive(with_template_mark(certificate_view(record, words, assets.kinds), words, assets), words,
                                assets);
}

std::vector<std::string> texts_of_every_page(const nlohmann::json& view) {
    std::vector<std::string> texts;
    for (const auto& [list, key] :
         {std::pair("identity", "number"), std::pair("mark", "text"), std::pair("changed_templates", "digest")}) {
        for (const nlohmann::json& entry : view.value(list, nlohmann::json::array())) {
            texts.push_back(entry.at(key).get<std::string>());
        }
    }
    return texts;
}

nlohmann::json view_of_budget_report(const EvaluationRecord& record, const RenderAssets& assets) {
    if (document_kind(record, assets.kinds).is_report()) {
        throw gum::InputError(gum::Diagnostic{.code = "GC-REPORT-0042",
                                              .where = "record",
                                              .what = "a comparison has no budget report",
                                              .rule = "its own report holds the budgets that were compared",
                                              .action = "use --format html or pdf"});
    }
    const Wording words = read_wording(assets, record);
    return with_template_mark(budget_report_view(record, words, assets.kinds), words, assets);
}

std::string render_budget_report_html(const EvaluationRecord& record, const RenderAssets& assets) {
    return view_as_html(view_of_budget_report(record, assets), assets);
}

}  // namespace gumcert::reports
