#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "gum/quantity/diagnostic.h"

namespace gumcert::reports {

/// What to do about a record that somebody changed.
inline constexpr const char* k_restore = "take the record as the program wrote it";

/// Collects what is wrong with a text; the list has an upper limit, so that a hostile text cannot fill the memory.
class RecordProblems {
public:
    explicit RecordProblems(std::string where) : where_(std::move(where)) {}

    void add(const char* code, const std::string& pointer, std::string what, std::string rule, std::string action) {
        if (list_.size() < k_limit) {
            list_.push_back(gum::Diagnostic{.code = code,
                                            .where = where_ + "#" + pointer,
                                            .what = std::move(what),
                                            .rule = std::move(rule),
                                            .action = std::move(action)});
        } else {
            ++left_out_;
        }
    }

    void throw_if_any() {
        if (list_.empty()) {
            return;
        }
        if (left_out_ > 0) {
            list_.push_back(gum::Diagnostic{.code = "GC-RECORD-0019",
                                            .where = where_,
                                            .what = std::to_string(left_out_) + " more problems",
                                            .rule = "at most " + std::to_string(k_limit) + " are listed",
                                            .action = "correct those above first"});
        }
        throw gum::InputError(std::move(list_));
    }

private:
    static constexpr std::size_t k_limit = 200;
    std::string where_;
    std::vector<gum::Diagnostic> list_;
    std::size_t left_out_ = 0;
};

}  // namespace gumcert::reports
