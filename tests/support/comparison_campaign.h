#pragma once

#include <map>
#include <string>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "jobs/comparison/comparison_job.h"

namespace gumcert::jobs::test {

using ComparisonFiles = std::map<std::string, std::string>;

/// A job from its keys without schema and kind.
inline std::string comparison_text(const std::string& keys) {
    return R"({"schema": "gumcert/job/1", "kind": "comparison", )" + keys + "}";
}

inline ComparisonJob read_comparison(const std::string& keys, ComparisonFiles files = {}) {
    files["job.json"] = comparison_text(keys);
    return read_comparison_job(MemoryFileSource(files), "job.json");
}

/// The refusals of a job; empty when it was accepted.
inline std::vector<gum::Diagnostic> comparison_refusals(const std::string& keys, const ComparisonFiles& files = {}) {
    try {
        (void)read_comparison(keys, files);
    } catch (const gum::InputError& error) {
        return error.diagnostics();
    } catch (const gum::StorageError& error) {
        return error.diagnostics();
    }
    return {};
}

/// Three laboratories with one result each.
inline const std::string k_three_laboratories =
    R"j("participants": [{"id": "A", "value": 10.1, "u": 0.1}, {"id": "B", "value": 10.3, "U": 0.4, "k": 2},
                          {"id": "C", "value": 9.9, "u": 0.2}])j";

/// A method at two points in two directions, against a reference method.
inline const std::string k_two_methods = R"j("unit": "um", "lab": "lab.csv", "reference": "reference.csv")j";
inline ComparisonFiles method_tables() {
    return {{"lab.csv",
             "point,direction,position,value,u\nP1,x,0,1.0,0.5\nP1,y,0,2.0,0.5\nP2,x,90,3.0,0.5\nP2,y,90,"
             "4.0,0.5\n"},
            {"reference.csv",
             "point,direction,value,U,k,u_common\nP2,y,4.1,0.4,2,0.1\nP2,x,3.1,0.4,2,0.1\n"
             "P1,y,2.1,0.4,2,0.1\nP1,x,1.1,0.4,2,0.1\n"}};
}

/// A budget of points P1 and P2, which depend on one standard.
inline std::string point_budget(const std::string& names = R"(["P1", "P2"])") {
    std::string points;
    for (std::size_t at = names.find('"'); at != std::string::npos; at = names.find('"', at + 1)) {
        const std::size_t end = names.find('"', at + 1);
        points += (points.empty() ? "" : ", ") + ("{\"point\": " + names.substr(at, end - at + 1)) + ", \"l\": 10}";
        at = end;
    }
    return R"({"schema": "gumcert/job/1", "kind": "budget", "model": ["x = l + s"],
  "inputs": {"l": {"value": 0, "u": 1, "unit": "um"}, "s": {"value": 0, "u": 2, "unit": "um", "source": "standard 1"}},
  "outputs": {"x": {"unit": "um"}})" +
           (points.empty() ? std::string() : ", \"points\": [" + points + "]") + "}";
}

}  // namespace gumcert::jobs::test
