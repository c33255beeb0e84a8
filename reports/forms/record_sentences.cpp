#include "reports/forms/record_sentences.h"

#include "reports/forms/asset_files.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <mutex>
#include <set>
#include <system_error>
#include <tuple>
#include <utility>

namespace gumcert::reports {

namespace {

class Sentences {
public:
    void add(const std::string& text) {
        if (!text.empty()) {
            texts_.insert(text);
        }
    }
    void add(const std::vector<std::string>& texts) {
        for (const std::string& text : texts) {
            add(text);
        }
    }
    void add(const gum::Diagnostic& d) {  // `where` names a place, as a rule of a file
        add(d.what);
        add(d.rule);
        add(d.action);
    }
    void add(const certificate::Certificate& certificate) {
        for (const certificate::Finding& finding : certificate.findings) {
            add(finding.what);
            add(finding.action);
        }
        for (const certificate::CertifiedTable& table : certificate.tables) {
            for (const certificate::CertifiedColumn& column : table.columns) {
                for (const certificate::CertifiedValue& value : column.values) {
                    add(value.outside_because);
                    if (value.verdict) {
                        add(value.verdict->note);
                    }
                }
            }
        }
    }
    void add(const RotaryTable& r) {
        add(r.adjustment.variance_factor.reason);
        add(r.adjustment.global_test.meaning);
        for (const FlaggedDistance& flagged : r.flagged) {
            add(flagged.reason);
        }
        if (r.iso230_2) {
            add(r.iso230_2->remarks);
        }
        if (r.monte_carlo) {
            add(r.monte_carlo->statement);
        }
        if (r.fixture_budget) {
            add(r.fixture_budget->remarks);
        }
    }
    [[nodiscard]] std::vector<std::string> take() const { return {texts_.begin(), texts_.end()}; }

private:
    std::set<std::string> texts_;
};

}  // namespace

std::vector<std::string> program_sentences_of(const EvaluationRecord& record) {
    Sentences all;
    for (const Result& result : record.results) {
        all.add(result.coverage_note);
    }
    for (const gum::Diagnostic& diagnostic : record.diagnostics) {
        all.add(diagnostic);
    }
    if (record.certificate) {
        all.add(*record.certificate);
    }
    if (record.rotary) {
        all.add(*record.rotary);
    }
    if (record.comparison) {
        all.add(record.comparison->remarks);
    }
    return all.take();
}

std::shared_ptr<const ProgramSentences> read_sentences(const std::filesystem::path& templates) {
    // To make patterns of the catalogue takes a third of the time of a small evaluation, to read it a twentieth.
    using State = std::tuple<std::filesystem::path, std::filesystem::file_time_type, std::uintmax_t>;
    static std::mutex one_at_a_time;
    static State made_of;
    static std::shared_ptr<const ProgramSentences> made;
    const std::filesystem::path file = templates / "wording" / "sentences.json";
    std::error_code failure;  // which reading tells
    const State state{file, std::filesystem::last_write_time(file, failure), std::filesystem::file_size(file, failure)};
    const std::lock_guard lock(one_at_a_time);
    if (!made || failure || state != made_of) {
        made = std::make_shared<const ProgramSentences>(read_json_asset(file));
        made_of = state;
    }
    return made;
}

void identify_sentences(EvaluationRecord& record, const ProgramSentences& catalogue) {
    record.statements.clear();
    std::set<std::string> seen;
    for (const std::string& text : program_sentences_of(record)) {
        for (IdentifiedSentence& sentence : catalogue.identified(text).value_or(std::vector<IdentifiedSentence>())) {
            if (seen.insert(sentence.text).second) {
                record.statements.push_back(std::move(sentence));
            }
        }
    }
}

}  // namespace gumcert::reports
