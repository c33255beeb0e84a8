#include "reports/audit/audit_form.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "reports/audit/audit_document.h"
#include "reports/audit/audit_html.h"
#include "reports/audit/audit_json.h"
#include "reports/audit/audit_sarif.h"
#include "reports/audit/audit_text.h"
#include "reports/forms/asset_files.h"
#include "reports/wording.h"

namespace gumcert::reports {

namespace {

constexpr std::array<AuditForm, 5> k_audit_forms{{
    {.name = "text",
     .file = "audit.txt",
     .description = "",
     .write =
         [](const AuditView& view, const AuditWriting& with) {
             return audit_as_text(view, read_audit_wording(with.assets()), with.verbose);
         }},
    {.name = "json",
     .file = "audit.json",
     .description = "for programs",
     .write = [](const AuditView& view, const AuditWriting& with) { return audit_as_json(view, with.run); }},
    {.name = "sarif",
     .file = "audit.sarif",
     .description = "for review tools",
     .write = [](const AuditView& view, const AuditWriting& with) { return audit_as_sarif(view, with.rules); }},
    {.name = "html",
     .file = "audit.html",
     .description = "for people, in one file",
     .write = [](const AuditView& view, const AuditWriting& with) { return audit_as_html(view, with.assets()); },
     .needs_file = true},
    {.name = "pdf",
     .file = "audit.pdf",
     .description = "",
     .write = [](const AuditView& view, const AuditWriting& with) { return audit_as_pdf(view, with.assets()); },
     .needs_file = true},
}};

}  // namespace

std::span<const AuditForm> audit_forms() {
    return k_audit_forms;
}

const AuditForm& audit_form(std::string_view name) {
    const auto form = std::ranges::find_if(k_audit_forms, [name](const AuditForm& one) { return one.name == name; });
    if (form == k_audit_forms.end()) {
        throw std::invalid_argument("no form of an audit: " + std::string(name));
    }
    return *form;
}

const AuditForm* audit_form_of(std::string_view file) {
    const auto form = std::ranges::find_if(k_audit_forms, [file](const AuditForm& one) {
        const auto ends_with = [file](const std::string& ending) {
            return file.size() > ending.size() && file.ends_with(ending);
        };
        return ends_with(std::string(one.file.substr(one.file.rfind('.')))) || ends_with("." + std::string(one.name));
    });
    return form == k_audit_forms.end() ? nullptr : &*form;
}

}  // namespace gumcert::reports
