#include "engine/job/problem_list.h"

#include <utility>

namespace gumcert::engine {

namespace {

std::vector<gum::Diagnostic> closed(std::vector<gum::Diagnostic> list, std::size_t count, const std::string& file) {
    if (count > list.size()) {
        gum::Diagnostic closing;
        closing.code = list.back().code;
        closing.severity = list.back().severity;
        closing.where = file;
        closing.what = "and " + std::to_string(count - list.size()) + " more";
        list.push_back(std::move(closing));
    }
    return list;
}

}  // namespace

void ProblemList::refuse(const InputCode& code, std::string where, std::string what, std::string rule,
                         std::string action) {
    ++refused_count_;
    if (refused_.size() < k_limit) {
        refused_.push_back({std::string{code.code}, std::move(where), std::move(what), std::move(rule),
                            std::move(action), gum::Severity::error});
    }
}

void ProblemList::warn(const InputCode& code, std::string where, std::string what, std::string rule,
                       std::string action) {
    ++warning_count_;
    if (warnings_.size() < k_limit) {
        warnings_.push_back({std::string{code.code}, std::move(where), std::move(what), std::move(rule),
                             std::move(action), gum::Severity::warning});
    }
}

std::vector<gum::Diagnostic> ProblemList::refused() const {
    return closed(refused_, refused_count_, file_);
}

std::vector<gum::Diagnostic> ProblemList::warnings() const {
    return closed(warnings_, warning_count_, file_);
}

}  // namespace gumcert::engine
