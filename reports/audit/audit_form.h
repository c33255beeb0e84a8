#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "audit/rule.h"
#include "reports/audit/audit_view.h"
#include "reports/forms/render.h"

namespace gumcert::reports {

/// What an audit is written with, in any form.
struct AuditWriting {
    std::span<const audit::Rule> rules;    ///< all that there are
    TaskRunner run = {};                   ///< as of audit_as_json()
    std::function<RenderAssets()> assets;  ///< templates and wording; asked by forms for people alone
    bool verbose = false;                  ///< text: the whole of each finding
};

/// A form that an audit is written in, in one row.
struct AuditForm {
    std::string_view name;         ///< after --format, and the ending of a file
    std::string_view file;         ///< in a folder: "audit.html"
    std::string_view description;  ///< for --help, where the name alone says too little
    std::string (*write)(const AuditView& view, const AuditWriting& with);
    bool needs_file = false;  ///< it is not for a terminal
};

/// The forms of an audit, in the order in which messages list them.
[[nodiscard]] std::span<const AuditForm> audit_forms();

/// The form with this name.
/// \throws std::invalid_argument  if there is none
[[nodiscard]] const AuditForm& audit_form(std::string_view name);

/// The form that the ending of a file's name means: "budget.txt" and "budget.text" are text, "budget.html" HTML.
/// \return none where it means no form of an audit
[[nodiscard]] const AuditForm* audit_form_of(std::string_view file);

}  // namespace gumcert::reports
