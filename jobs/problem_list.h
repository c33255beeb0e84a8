#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "jobs/input_codes.h"

namespace gumcert::jobs {

/// Collects what is wrong with one file, so that a person sees everything at once and not one problem a run.
///
/// The first `k_limit` refusals are kept, and the first `k_limit` warnings; the lists close with "and N more". What was
/// said already, word for word of the same place, is not said again. One cause in a column of a table is one message:
/// problems of one `group` with the same code, rule and action are listed once, with their number.
class ProblemList {
public:
    static constexpr std::size_t k_limit = 200;

    explicit ProblemList(std::string file) : file_(std::move(file)) {}

    /// \param group  the column, or the key of many points, that the problem stands in; "" where it stands alone
    void refuse(const InputCode& code, std::string where, std::string what, std::string rule, std::string action,
                const std::string& group = {});
    void warn(const InputCode& code, std::string where, std::string what, std::string rule, std::string action,
              const std::string& group = {});
    /// Something to know, nothing to do; among the warnings.
    void note(const InputCode& code, std::string where, std::string what, std::string rule, std::string action);
    /// Puts everything that another list holds behind what is here.
    void take(const ProblemList& other);
    /// \param if_told  which of its refusals; its warnings are left
    void take(const ProblemList& other, const std::function<bool(const gum::Diagnostic&)>& if_told);

    [[nodiscard]] const std::string& file() const noexcept { return file_; }
    /// Number of refusals, those beyond the limit and the repeated ones included.
    [[nodiscard]] std::size_t refusals() const noexcept { return refused_count_; }
    [[nodiscard]] std::vector<gum::Diagnostic> refused() const;
    [[nodiscard]] std::vector<gum::Diagnostic> warnings() const;

private:
    /// Messages of one severity class.
    struct Messages {
        struct Entry {
            gum::Diagnostic diagnostic;
            std::string group;
            std::size_t repeats = 0;  ///< further problems of its group
            std::string last;         ///< place of the last of them
        };
        std::vector<Entry> entries;  ///< the first k_limit
        std::size_t beyond = 0;      ///< more than that

        void add(gum::Diagnostic diagnostic, const std::string& group);
        [[nodiscard]] std::vector<gum::Diagnostic> closed(const std::string& file) const;
    };

    std::string file_;
    Messages refused_, warnings_;
    std::size_t refused_count_ = 0;
};

}  // namespace gumcert::jobs
