#include "jobs/problem_list.h"

#include <algorithm>
#include <utility>

namespace gumcert::jobs {

void ProblemList::Messages::add(gum::Diagnostic diagnostic, const std::string& group) {
    const auto same = std::find_if(entries.begin(), entries.end(), [&](const Entry& entry) {
        const gum::Diagnostic& known = entry.diagnostic;
        return known == diagnostic || (!group.empty() && entry.group == group && known.code == diagnostic.code &&
                                       known.rule == diagnostic.rule && known.action == diagnostic.action);
    });
    if (same != entries.end()) {
        if (!(same->diagnostic == diagnostic) && same->last != diagnostic.where) {
            ++same->repeats;
            same->last = std::move(diagnostic.where);
        }
    } else if (entries.size() < k_limit) {
        entries.push_back({std::move(diagnostic), group, 0, {}});
    } else {
        ++beyond;
    }
}

std::vector<gum::Diagnostic> ProblemList::Messages::closed(const std::string& file) const {
    std::vector<gum::Diagnostic> list;
    for (const Entry& entry : entries) {
        list.push_back(entry.diagnostic);
        if (entry.repeats > 0) {
            list.back().what += "; the same in " + std::to_string(entry.repeats) + " more place" +
                                (entry.repeats == 1 ? ", " : "s, the last is ") + entry.last;
        }
    }
    if (beyond > 0) {
        gum::Diagnostic closing;
        closing.code = list.back().code;
        closing.severity = list.back().severity;
        closing.where = file;
        closing.what = "and " + std::to_string(beyond) + " more";
        list.push_back(std::move(closing));
    }
    return list;
}

void ProblemList::refuse(const InputCode& code, std::string where, std::string what, std::string rule,
                         std::string action, const std::string& group) {
    ++refused_count_;
    refused_.add({std::string{code.code}, std::move(where), std::move(what), std::move(rule), std::move(action),
                  gum::Severity::error},
                 group);
}

void ProblemList::warn(const InputCode& code, std::string where, std::string what, std::string rule, std::string action,
                       const std::string& group) {
    warnings_.add({std::string{code.code}, std::move(where), std::move(what), std::move(rule), std::move(action),
                   gum::Severity::warning},
                  group);
}

void ProblemList::note(const InputCode& code, std::string where, std::string what, std::string rule,
                       std::string action) {
    warnings_.add({std::string{code.code}, std::move(where), std::move(what), std::move(rule), std::move(action),
                   gum::Severity::note},
                  {});
}

void ProblemList::take(const ProblemList& other) {
    refused_count_ += other.refused_count_;
    for (const Messages::Entry& entry : other.refused_.entries) {
        refused_.add(entry.diagnostic, entry.group);
    }
    refused_.beyond += other.refused_.beyond;
    for (const Messages::Entry& entry : other.warnings_.entries) {
        warnings_.add(entry.diagnostic, entry.group);
    }
    warnings_.beyond += other.warnings_.beyond;
}

void ProblemList::take(const ProblemList& other, const std::function<bool(const gum::Diagnostic&)>& if_told) {
    for (const Messages::Entry& entry : other.refused_.entries) {
        if (if_told(entry.diagnostic)) {
            ++refused_count_;
            refused_.add(entry.diagnostic, entry.group);
        }
    }
}

std::vector<gum::Diagnostic> ProblemList::refused() const {
    return refused_.closed(file_);
}

std::vector<gum::Diagnostic> ProblemList::warnings() const {
    return warnings_.closed(file_);
}

}  // namespace gumcert::jobs
