#pragma once

#include <algorithm>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "audit/audit.h"
#include "audit/rules/registry.h"

namespace gumcert::test {

/// The rules with some ids, in the order of the registry.
inline std::vector<audit::Rule> rules_named(std::initializer_list<std::string_view> ids) {
    std::vector<audit::Rule> rules;
    for (const audit::Rule& rule : audit::all_rules()) {
        if (std::find(ids.begin(), ids.end(), rule.id) != ids.end()) {
            rules.push_back(rule);
        }
    }
    return rules;
}

/// The rules of some families: "USK".
inline std::vector<audit::Rule> rules_of_families(std::string_view letters) {
    std::vector<audit::Rule> rules;
    for (const audit::Rule& rule : audit::all_rules()) {
        if (letters.find(rule.id.front()) != std::string_view::npos) {
            rules.push_back(rule);
        }
    }
    return rules;
}

/// What some rules alone find.
inline audit::AuditReport report_of(std::initializer_list<std::string_view> ids, audit::AuditSubject subject) {
    return audit::audit(std::move(subject), rules_named(ids));
}

inline std::vector<audit::AuditFinding> findings_of(std::string_view id, audit::AuditSubject subject) {
    return report_of({id}, std::move(subject)).findings;
}

}  // namespace gumcert::test
