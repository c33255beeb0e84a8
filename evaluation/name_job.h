#pragma once

#include <filesystem>
#include <vector>

#include "gum/quantity/diagnostic.h"

/// Of several jobs in one command nobody knows which one "job.json#/model" is in: what readers say names no folder.
namespace gumcert::evaluation {

/// The same, and where it is names the job with its folder: "b/job.json#/model", "b/job.json, points.csv:3:1".
[[nodiscard]] std::vector<gum::Diagnostic> of_job(std::vector<gum::Diagnostic> diagnostics,
                                                  const std::filesystem::path& job);

/// Work on one job; what is refused names it where the command has several.
template <class Work>
auto naming_job(const std::filesystem::path& job, bool several, const Work& work) {
    if (!several) {
        return work();
    }
    try {
        return work();
    } catch (const gum::InputError& error) {
        throw gum::InputError(of_job(error.diagnostics(), job));
    } catch (const gum::NoResultError& error) {
        throw gum::NoResultError(of_job(error.diagnostics(), job));
    } catch (const gum::StorageError& error) {
        throw gum::StorageError(of_job(error.diagnostics(), job));
    }
}

}  // namespace gumcert::evaluation
