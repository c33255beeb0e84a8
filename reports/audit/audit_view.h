#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "audit/audit.h"
#include "audit/rule.h"
#include "audit/sentence.h"

namespace gumcert::reports {

// Everything that the forms of an audit show, made once, so that they all say the same. A number stands beside its text;
// texts have a point as decimal sign and '-' as minus sign, "" where there is nothing to print. Texts that come from a
// file or name one are printable() here already; every form still escapes them for its own language.

/// A finding that a person accepts, with a name under it, as it is printed.
struct PrintedWaiver {
    std::string rule;        ///< "U10"
    std::string where = {};  ///< as the finding has it; "" the rule as a whole
    std::string by, when, reason;
    friend bool operator==(const PrintedWaiver&, const PrintedWaiver&) = default;
};

/// A file that somebody asked to audit, and that has no audit: every form says so where it begins.
struct UnauditedFile {
    enum class Kind {
        refused,    ///< because: why
        in_record,  ///< a job that was evaluated again for the record that was made of it; because: the record
        other_kind  ///< of a folder, and nothing that an audit reads
    };
    Kind kind = Kind::refused;
    std::string file = {}, because = {};
};

/// What the caller knows beside the reports.
struct AuditContext {
    std::string program = {};               ///< "gumcert 0.1.0"
    std::vector<std::string> digests = {};  ///< SHA-256 of the files, in the order of the reports; empty: not printed
    std::vector<UnauditedFile> unaudited = {};
};

struct PrintedOutcome {
    audit::BudgetOutcome number;
    std::string value, u_c, nu_eff, k, U, En;
    std::string verdict;  ///< as records write it: "pass"; of a claim: as it is stated
};

struct PrintedInterval {
    audit::Interval number;
    std::string low, high;
};

/// What correcting a finding does to U.
struct Change {
    double relative = 0.0;  ///< of U
    std::string percent;    ///< "+21.4", "0.0"
    std::string
        direction;  ///< "understated", "overstated", "unchanged", "not_stated", "interval": how U stands before the correction
    bool verdict_turns = false;   ///< another verdict
    bool En_crosses_one = false;  ///< |E_n| moves across 1
    [[nodiscard]] bool decision_turns() const { return verdict_turns || En_crosses_one; }
};
[[nodiscard]] Change change_of(const audit::BudgetOutcome& before, const audit::BudgetOutcome& after);

struct AuditedRowView {
    std::string quantity, unit, estimate, stated, divisor, u, sensitivity, nu, source, comment, place;
    std::string shape;          ///< as the table has it; "" where it names none
    std::string shape_name;     ///< "normal", "uniform" …: a name of the wording's distribution_name; "" not stated
    double contribution = 0.0;  ///< |c| u, unit of the result
    std::string contribution_text;
    double share = 0.0;         ///< of the sum of the squares of all contributions
    std::string share_percent;  ///< "62.1"
    bool in_sum = true;
    std::vector<std::size_t> findings;  ///< positions in AuditedFileView::findings
};

/// One of the contributors that every budget has, with a number or with a reason.
struct ContributorView {
    std::string id;  ///< "reference", "stability", "resolution", "repeatability", "reproducibility", "environment"
    std::vector<std::string> rows;  ///< quantities that stand for it; empty: the budget has none
    double contribution = 0.0;      ///< root of the sum of their squares
    std::string contribution_text, share_percent;
    std::string reason;  ///< comments of rows whose contribution is 0
};

struct AuditedResultView {
    std::string name, unit, place, equation, method;
    std::string capability;                      ///< U of the scope here; "" none is known
    std::string coverage;                        ///< "fixed", "student_t", "convolution", "of_sheet"
    std::string coverage_probability, stated_k;  ///< of the rule of coverage; one of both
    std::string lower_limit, upper_limit, reference_name, reference_value, reference_U;
    PrintedOutcome claimed, recomputed, audited;
    PrintedInterval u_c, nu_eff, k, U;  ///< what the printed digits of the rows allow
    struct Claim {
        bool stated = false;  ///< by the file; else the number follows from its rows
        bool allowed = true;  ///< what its digits leave open meets what those of the rows allow
    };
    Claim claim_u_c, claim_nu_eff, claim_k, claim_U;
    Change change;  ///< from claimed to audited
    bool sampled_shares = false;
    bool is_nested = false;            ///< of a budget that the results rest on
    std::vector<AuditedRowView> rows;  ///< the largest contribution first
    std::vector<ContributorView> contributors;
    std::vector<std::size_t> findings;  ///< that touch it: positions in AuditedFileView::findings
    /// Whether the file states all four numbers of its outcome.
    [[nodiscard]] bool all_stated() const {
        return claim_u_c.stated && claim_nu_eff.stated && claim_k.stated && claim_U.stated;
    }
    std::string budget_U;  ///< k u_c of the rows, without the capability
    double budget_U_number = 0.0;
    std::optional<double> capability_number;
};

struct EffectView {
    PrintedOutcome claimed, alone, last, audited;
    double share = 0.0;
    std::string share_percent;  ///< "+12.0" points of percent
    Change change_alone;        ///< from claimed to alone
    Change change_last;         ///< from last to audited
    std::size_t result = 0;     ///< position in AuditedFileView::results
};

struct MissingTermView {
    audit::MissingTerm number;
    std::string u_for_digit, u_for_verdict;  ///< the second "" where no term changes the decision
    std::string unit;
};

struct AuditFindingView {
    std::string id, title;
    std::string severity;  ///< "critical", "major", "minor", "information"
    std::string clause;
    bool clause_verified = false;
    std::string where, correction, question;
    audit::Sentence what, expected, actual;
    std::vector<audit::Sentence> evidence;
    std::vector<std::size_t> results;  ///< that it touches: positions in AuditedFileView::results
    std::optional<EffectView> effect;
    std::optional<EffectView>
        effect_on_score;  ///< on the result that is compared with a reference, where it is another one
    std::optional<MissingTermView> missing_term;
    std::optional<std::size_t> waiver;  ///< position in the waivers of its file; in a view of several in those of all
};

struct NotCheckedView {
    std::string id, title;
    audit::Sentence because;
};

/// What a rule found, or why it was not applied.
struct RuleAnswer {
    std::string id, title;
    audit::Sentence answer;
};

/// One question to the laboratory, and the findings that ask it.
struct QuestionView {
    std::string question;
    std::vector<std::size_t> findings;
};

struct AuditedFileView {
    std::string name;
    std::string kind;  ///< "job", "record", "table", "workbook", "certificate"
    std::string sha256;
    struct ScopeLine {
        std::string id, measurand, range, form;
    };
    std::vector<ScopeLine> scope;
    std::string method;  ///< of the certificate; "" none is stated
    std::vector<AuditedResultView> results;
    std::size_t worst = 0;  ///< of `results`, where there are any
    /// How many of the results are no nested ones: those of the file itself.
    [[nodiscard]] std::size_t own_results() const;
    std::vector<AuditFindingView> findings;  ///< the gravest first
    std::array<std::size_t, 4> counts{};     ///< of findings: critical, major, minor, information
    std::vector<RuleAnswer> linearity;       ///< of the rules on the linear model and on Monte Carlo
    std::vector<NotCheckedView> not_checked;
    std::vector<audit::Sentence> not_read;
    std::vector<QuestionView> questions;
    std::vector<PrintedWaiver> waivers;  ///< of this file; in a view of several those of all stand in AuditView
    bool sampled_shares = false;         ///< of one of its results
};

struct AuditView {
    std::string program;
    std::vector<AuditedFileView> files;
    std::size_t worst = 0;               ///< of `files`
    std::vector<PrintedWaiver> waivers;  ///< of all files, each once
    std::vector<UnauditedFile> unaudited;
};

/// Sentences as files for programs hold them.
[[nodiscard]] std::vector<std::string> english_of(const std::vector<audit::Sentence>& sentences);

/// "critical", "major", "minor", "information": the order of AuditedFileView::counts.
inline constexpr std::array<const char*, 4> k_audit_severities{"critical", "major", "minor", "information"};

/// Rows from a position on as one: root of the sum of the squares of their contributions, and the sum of their shares.
[[nodiscard]] AuditedRowView summed_rows(const AuditedResultView& result, std::size_t from);

/// Does tasks 0 … n − 1, in any order and several at once where it can; empty: one after the other. It makes no difference
/// to what comes out.
using TaskRunner = std::function<void(std::size_t n, const std::function<void(std::size_t)>& task)>;
void run_tasks(const TaskRunner& run, std::size_t n, const std::function<void(std::size_t)>& task);

/// The view of one file alone: many of them are made before they are put together, and their reports need not be kept.
/// \param rules   for titles and clauses: those that the audit was made with
/// \param sha256  of the file; "" where it is not printed
[[nodiscard]] AuditedFileView make_file_view(const audit::AuditReport& report, std::span<const audit::Rule> rules,
                                             const std::string& sha256 = "");

/// Tells one thing more that was not looked at in a file.
void add_not_read(AuditedFileView& file, const audit::Sentence& sentence);

/// The view of the audits of one file or of a folder.
///
/// The worst result of a file is the one that the corrections change most: a verdict or |E_n| > 1 that turns counts
/// before U, then the largest relative change of U, then the first; nested ones are not among them. The worst file is the one with the gravest finding,
/// then by its worst result.
/// \param files    one or more, in the order in which they are shown
[[nodiscard]] AuditView make_audit_view(std::vector<AuditedFileView> files, const AuditContext& context);
/// \param rules    for titles and clauses: those that the audits were made with
[[nodiscard]] AuditView make_audit_view(std::span<const audit::AuditReport> reports, std::span<const audit::Rule> rules,
                                        const AuditContext& context, const TaskRunner& run = {});

}  // namespace gumcert::reports
