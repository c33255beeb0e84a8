#pragma once

#include <string>

#include "gum/quantity/diagnostic.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::test {

/// What a text is refused for as a record, a line each; "accepted" when it is not.
inline std::string record_refusal(const std::string& text) {
    try {
        static_cast<void>(reports::record_from_json(text, "record.json"));
    } catch (const gum::InputError& refused) {
        std::string all;
        for (const gum::Diagnostic& problem : refused.diagnostics()) {
            all += problem.code + " " + gum::message(problem) + "\n";
        }
        return all;
    }
    return "accepted";
}

}  // namespace gumcert::test
