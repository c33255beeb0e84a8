#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/job/input_codes.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::engine {

/// Collects what is wrong with one file, so that a person sees everything at once and not one problem a run.
///
/// The first `k_limit` refusals are kept, and the first `k_limit` warnings; the lists close with "and N more".
class ProblemList {
public:
    static constexpr std::size_t k_limit = 200;

    explicit ProblemList(std::string file) : file_(std::move(file)) {}

    void refuse(const InputCode& code, std::string where, std::string what, std::string rule, std::string action);
    void warn(const InputCode& code, std::string where, std::string what, std::string rule, std::string action);

    [[nodiscard]] const std::string& file() const noexcept { return file_; }
    /// Number of refusals, those beyond the limit included.
    [[nodiscard]] std::size_t refusals() const noexcept { return refused_count_; }
    [[nodiscard]] std::vector<gum::Diagnostic> refused() const;
    [[nodiscard]] std::vector<gum::Diagnostic> warnings() const;

private:
    std::string file_;
    std::vector<gum::Diagnostic> refused_;
    std::vector<gum::Diagnostic> warnings_;
    std::size_t refused_count_ = 0;
    std::size_t warning_count_ = 0;
};

}  // namespace gumcert::engine
