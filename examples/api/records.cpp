// Reads what others hand in: a record of gumcert, whose digest tells whether it is whole, a signature, and any JSON.
#include <cstdio>
#include <string>
#include <vector>

#include "certificate/capability.h"
#include "certificate/gates/gates.h"
#include "encoding/file_bytes.h"
#include "gum/quantity/diagnostic.h"
#include "json/strict_parser.h"
#include "reports/record/evaluation_record.h"
#include "signing/verify.h"
#include "text/numbers.h"

using namespace gumcert;

int main(int count, char** words) try {
    for (int i = 1; i < count; ++i) {
        const std::string text = encoding::read_regular_file(words[i], std::size_t{1} << 26U).bytes;
        if (text.rfind("{", 0) != 0) {
            const signing::Verification found = signing::verify_signatures(text, words[i], {}, 0);
            std::printf("%s: %zu signatures\n", found.kind.c_str(), found.signatures.size());
            continue;
        }
        const reports::EvaluationRecord record = reports::record_from_json(text, words[i]);
        for (const reports::Result& result : record.results) {
            // Numbers stand unrounded beside the text that documents print.
            std::printf("%s = %s %s, U = %s (u = %s %s)\n", result.name.c_str(), result.reported.printed.value.c_str(),
                        result.reported.printed.unit.c_str(), result.reported.printed.U.c_str(),
                        text::significant(result.u, 4).c_str(), result.unit.c_str());
        }
        std::printf("written again it is the same text: %s\n",
                    reports::to_canonical_json(record) == text ? "yes" : "no");
    }

    // Every fault of a text with its place; a reader of ordinary JSON would take the second value without a word.
    (void)json::parse("{\"u\": 0.5,\n \"u\": 5}", {}, [](const json::ParsingProblem& problem) {
        std::printf("line %zu, column %zu: %s\n", problem.place.line, problem.place.column, problem.what.c_str());
    });

    // The capability of a scope, U = Q[0.05, 0.5 L] um with L in m (ILAC-P14:09/2020, section 4), at 0.1 m.
    certificate::Capability capability;
    capability.form = "function";
    capability.unit = "um";
    capability.arguments = {{.name = "L", .unit = "m"}};
    capability.expression = "Q[0.05, 0.5*L]";
    std::printf("capability at 0.1 m: %s um\n",
                text::significant(*capability_at(capability, {{"L", 0.1}}).U, 3).c_str());

    certificate::Certificate empty;  // nothing is stated: the gates say what a certificate needs
    certificate::pass_gates(empty);
    std::printf("missing first of all: %s\n", empty.findings.front().clause.c_str());
    return 0;
} catch (const gum::DiagnosedError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
