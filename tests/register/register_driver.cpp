// What the register says of made-up standards, for an oracle that computes it again: register_driver CASES
//
// CASES holds one JSON object a line, {"standard": a file of standards/, "use": {quantity, range, mode, at, date}}. One line
// is written for each: applicability, value with drift, and the next calibration, or the code of what was refused.
#include <exception>
#include <fstream>
#include <iostream>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "gum/quantity/diagnostic.h"
#include "jobs/json_object.h"
#include "jobs/laboratory/register_reader.h"
#include "laboratory/applicability.h"
#include "laboratory/recalibration.h"
#include "laboratory/standard_value.h"

namespace {

using namespace gumcert;  // NOLINT(google-build-using-namespace): one program, one file
using nlohmann::json;

const char* word_of(laboratory::Answer answer) {
    return answer == laboratory::Answer::yes ? "yes" : answer == laboratory::Answer::no ? "no" : "unknown";
}

laboratory::StandardUse use_of(const json& use) {
    laboratory::StandardUse out{.quantity = use.value("quantity", ""),
                                .range = use.value("range", ""),
                                .mode = use.value("mode", ""),
                                .at = {},
                                .date = use.value("date", "")};
    if (use.contains("at")) {
        out.at = use.at("at").get<double>();
    }
    return out;
}

json value_of(const laboratory::StandardRecord& record, const laboratory::StandardUse& use) {
    try {
        const laboratory::StandardValue v = laboratory::value_of_standard(record, use);
        const bool finite = v.drift.nu < std::numeric_limits<double>::infinity();
        return {{"value", v.value},
                {"u", v.k ? v.U / *v.k : laboratory::standard_uncertainty(*v.result)},
                {"interpolation", v.interpolation_half_width},
                {"drift", v.drift.value},
                {"drift_u", v.drift.u},
                {"drift_half_width", v.drift.half_width},
                {"drift_nu", finite ? json(v.drift.nu) : json()}};
    } catch (const gum::InputError& error) {
        return {{"code", error.diagnostics().front().code}};
    }
}

json interval_of(const laboratory::StandardRecord& record) {
    try {
        const auto next = laboratory::next_calibration(record, record.calibrations.back().results.front());
        return next ? json{{"days", next->days}, {"due", next->due}} : json();
    } catch (const gum::InputError& error) {
        return {{"code", error.diagnostics().front().code}};
    }
}

json answer_to(const json& one) {
    const jobs::JsonDocument document = jobs::parse_json_document(one.at("standard").dump(), "standard");
    jobs::ProblemList problems("standard");
    const std::optional<laboratory::StandardRecord> record = jobs::read_standard(document, problems);
    if (!record) {
        return {{"refused", gum::message(problems.refused().front())}};
    }
    const laboratory::StandardUse use = use_of(one.at("use"));
    return {{"applicable", word_of(laboratory::applicability(*record, use).answer)},
            {"value", value_of(*record, use)},
            {"interval", interval_of(*record)}};
}

}  // namespace

int main(int argc, char** argv) {
    try {
        std::ifstream cases(argc > 1 ? argv[1] : "");
        if (!cases) {
            std::cerr << "register_driver: no file with cases\n";
            return 2;
        }
        for (std::string line; std::getline(cases, line);) {
            std::cout << answer_to(nlohmann::json::parse(line)).dump() << "\n";
        }
    } catch (const std::exception& error) {
        std::cerr << "register_driver: " << error.what() << "\n";
        return 1;
    }
    return 0;
}
