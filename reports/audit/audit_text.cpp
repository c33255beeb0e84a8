#include "reports/audit/audit_text.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "reports/audit/audit_words.h"
#include "reports/forms/text_columns.h"

namespace gumcert::reports {
namespace {

/// A text in lines; the first line begins with `first`, the others with blanks of the same width.
std::string paragraph_of(const std::string& first, const std::string& text) {
    if (width(first) > k_columns / 2) {  // the name of something hostile or long
        return paragraph_of("  ", first + text);
    }
    const std::string blanks(width(first), ' ');
    std::string out;
    for (const std::string& line : wrapped(text, k_columns - width(first))) {
        out += (out.empty() ? first : blanks) + line + "\n";
    }
    return out;
}

/// A label and its text: "  where       row 3".
std::string labelled(const std::string& label, const std::string& text) {
    constexpr std::size_t k_label = 15;
    return text.empty() ? ""
                        : paragraph_of("    " + padded(label, std::max(k_label, width(label)), false) + "  ", text);
}

std::string counts_of(const AuditedFileView& file, const AuditWords& words) {
    std::string text;
    for (std::size_t i = 0; i < file.counts.size(); ++i) {
        text +=
            (text.empty() ? "" : ", ") + words.severity(k_audit_severities[i]) + " " + std::to_string(file.counts[i]);
    }
    return text;
}

using Line = std::array<std::string, 6>;

/// Lines of a small table, the first column to the left and the others to the right.
std::string columns_of(const std::vector<Line>& lines) {
    std::array<std::size_t, 6> widths{};
    for (const Line& line : lines) {
        for (std::size_t c = 0; c < line.size(); ++c) {
            widths[c] = std::max(widths[c], width(line[c]));
        }
    }
    std::string out;
    for (const Line& line : lines) {
        std::string text = "  ";
        for (std::size_t c = 0; c < line.size(); ++c) {
            text += (c == 0 ? "" : "  ") + padded(line[c], widths[c], c > 0);
        }
        text.erase(text.find_last_not_of(' ') + 1);
        // wrapped() takes the blanks of the table for gaps between words.
        out += width(text) <= k_columns ? text + "\n" : paragraph_of("  ", text);
    }
    return out;
}

std::string outcomes_of(const AuditedResultView& result, const AuditWords& words) {
    const std::string unit = result.unit.empty() ? "" : " / " + result.unit;
    const auto line = [&words](const std::string& name, const PrintedOutcome& outcome) {
        return Line{words(name),
                    words.number(outcome.u_c),
                    words.number(outcome.nu_eff),
                    words.number(outcome.k),
                    words.number(outcome.U),
                    words.verdict(outcome.verdict)};
    };
    return columns_of({Line{"", "u_c" + unit, "ν_eff", "k", "U" + unit, words("verdict")},
                       line("claimed", result.claimed),
                       Line{words("allowed"), words.interval(result.u_c), words.interval(result.nu_eff),
                            words.interval(result.k), words.interval(result.U), ""},
                       line("recomputed", result.recomputed), line("audited", result.audited)});
}

std::string finding_text(const AuditFindingView& finding, std::size_t position, const AuditedFileView& file,
                         const std::vector<PrintedWaiver>& waivers, const AuditWords& words) {
    std::string out =
        paragraph_of(padded(std::to_string(position), 3, true) + " ",
                     words.severity(finding.severity) + ": " + finding.id + " " + words.sentence(finding.title).text);
    if (finding.waiver && *finding.waiver < waivers.size()) {
        const PrintedWaiver& waiver = waivers[*finding.waiver];
        out += labelled(words("accepted_by"), waiver.by + ", " + waiver.when + ": " + waiver.reason);
    }
    out += labelled(words("where"), finding.where);
    out += labelled(words("what"), words.said(finding.what).text);
    if (finding.effect) {
        const EffectView& effect = *finding.effect;
        out += labelled(words("alone"), words.effect_alone(effect, file));
        out += labelled(words("last"), words.effect_last(effect, file));
        out += labelled(words("share_of_change"), words.number(effect.share_percent) + " %");
    }
    if (finding.effect_on_score) {
        out += labelled(words("score"), words.effect_on_score(*finding.effect_on_score, file));
    }
    if (finding.missing_term) {
        out += labelled(words("bound"), words.missing_term(*finding.missing_term));
    }
    for (const audit::Sentence& evidence : finding.evidence) {
        out += labelled(words("evidence"), words.said(evidence).text);
    }
    out += labelled(words("correction"), words.sentence(finding.correction).text);
    out += labelled(words("clause"), words.clause(finding));
    return out;
}

std::string waivers_of(const AuditView& view, const AuditWords& words) {
    std::string out;
    for (const PrintedWaiver& waiver : view.waivers) {
        out += paragraph_of("  " + waiver.rule + "  ", (waiver.where.empty() ? "" : waiver.where + ": ") +
                                                           waiver.reason + " (" + waiver.by + ", " + waiver.when + ")");
    }
    return out.empty() ? "" : "\n" + words("waivers") + "\n" + out;
}

std::string questions_of(const AuditedFileView& file, const AuditWords& words) {
    std::string out;
    for (std::size_t i = 0; i < file.questions.size(); ++i) {
        std::string asked_by;
        for (const std::size_t finding : file.questions[i].findings) {
            const std::string& id = file.findings[finding].id;
            if (asked_by.find(id) == std::string::npos) {
                asked_by += (asked_by.empty() ? "" : ", ") + id;
            }
        }
        out += paragraph_of(padded(std::to_string(i + 1), 3, true) + " ",
                            words.sentence(file.questions[i].question).text + " (" + asked_by + ")");
    }
    return out.empty() ? "" : "\n" + words("questions") + "\n" + out;
}

std::string not_checked_of(const AuditedFileView& file, const AuditWords& words, bool verbose) {
    if (file.not_checked.empty()) {
        return "";
    }
    std::string out = "\n" + words.filled("rules_not_checked", {{"count", std::to_string(file.not_checked.size())}});
    out += verbose ? "\n" : " " + words("verbose_lists_them") + "\n";
    for (const NotCheckedView& one : file.not_checked) {
        if (verbose) {
            out += paragraph_of("  " + padded(one.id, 5, false) + " ",
                                words.sentence(one.title).text + ": " + words.said(one.because).text);
        }
    }
    return out;
}

std::string list_of(const std::string& heading, const std::vector<AuditSentence>& sentences) {
    std::string out;
    for (const AuditSentence& sentence : sentences) {
        out += paragraph_of("  ", sentence.text);
    }
    return out.empty() ? "" : "\n" + heading + "\n" + out;
}

std::string file_text(const AuditedFileView& file, const std::vector<PrintedWaiver>& waivers, const AuditWords& words,
                      bool verbose) {
    std::string out = paragraph_of("", file.name + " (" + words.file_kind(file.kind) + ")");
    out += paragraph_of("  ", counts_of(file, words));
    if (file.results.empty()) {
        out += paragraph_of("  ", words("no_results"));
    } else {
        const AuditedResultView& worst = file.results[file.worst];
        out += "\n" + paragraph_of("  ", worst.name + ": " +
                                             words.change(worst.claimed, worst.audited, worst.change, worst.unit));
        out += outcomes_of(worst, words);
        if (file.own_results() > 1) {
            out += paragraph_of("  ", words.filled("worst_of", {{"count", std::to_string(file.own_results())}}));
        }
    }
    out += list_of(words("not_looked_at"), words.limits(file));
    out += "\n" + words("findings") + "\n";
    if (file.findings.empty()) {
        out += paragraph_of("  ", words("no_findings"));
    }
    for (std::size_t i = 0; i < file.findings.size(); ++i) {
        out += finding_text(file.findings[i], i + 1, file, waivers, words);
    }
    out += questions_of(file, words);
    if (!all_is_named_first(file)) {
        out += "\n" + words("not_read") + "\n";
        for (const audit::Sentence& sentence : file.not_read) {
            out += paragraph_of("  ", words.said(sentence).text);
        }
    }
    return out + not_checked_of(file, words, verbose);
}

}  // namespace

std::string audit_as_text(const AuditView& view, const Wording& wording, bool verbose) {
    const AuditWords words(wording);
    std::string out = list_of(words("unaudited"), words.unaudited(view));
    out.erase(0, out.empty() ? 0 : 1);  // nothing stands above it
    for (const AuditedFileView& file : view.files) {
        out += (out.empty() ? "" : "\n") + file_text(file, view.waivers, words, verbose);
    }
    return out + waivers_of(view, words);
}

}  // namespace gumcert::reports
