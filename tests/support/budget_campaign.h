#pragma once

#include <map>
#include <string>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "jobs/budget/budget_job.h"

namespace gumcert::jobs::test {

using BudgetFiles = std::map<std::string, std::string>;

/// A job of one line, from its keys without schema and kind.
inline std::string budget_text(const std::string& keys) {
    return R"({"schema": "gumcert/job/1", "kind": "budget", )" + keys + "}";
}

inline BudgetJob read_budget(const std::string& keys, BudgetFiles files = {}) {
    files["job.json"] = budget_text(keys);
    return read_budget_job(MemoryFileSource(files), "job.json");
}

/// A job with one input X and no model.
inline gum::BudgetInput read_one_input(const std::string& statement, const BudgetFiles& files = {}) {
    return read_budget(R"("inputs": {"X": )" + statement + "}", files).inputs.at(0);
}

/// The refusals of a job; empty when it was accepted.
inline std::vector<gum::Diagnostic> budget_refusals(const std::string& keys, const BudgetFiles& files = {}) {
    try {
        (void)read_budget(keys, files);
    } catch (const gum::InputError& error) {
        return error.diagnostics();
    }
    return {};
}

}  // namespace gumcert::jobs::test
