#include "app/cli/archive/certificate_life.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/cli/archive/action.h"
#include "app/cli/terminal/clock.h"
#include "app/cli/terminal/interruption.h"
#include "app/cli/terminal/share_folder.h"
#include "app/cli/terminal/terminal.h"
#include "archive/archive.h"
#include "archive/certificates/archive_draft.h"
#include "evaluation/limits.h"
#include "signing/verify.h"
#include "text/visible_text.h"

namespace gumcert::cli {

namespace {

ExitCode add_draft(const ArchiveOptions& options, const CommonOptions& common, bool is_amendment) {
    const auto store = opened(options, archive::Access::read_and_write);
    archive::Archive archive(*store);
    ProgressLine progress(!common.quiet);
    archive::ArchiveChecks checks{
        .threads = static_cast<unsigned>(common.threads),
        .templates = templates_folder(options.share),
        .trusted = {},
        .now = seconds_now(),
        .progress = [&](const std::string& text) { progress(text); },
        .within_walls = [&](const auto& files,
                            const std::function<void()>& work) { work_within_walls(common, files, work); },
        .evaluates_within =
            [&](const std::function<void()>& work) {
                work_within_walls(common, evaluation::walls_of_evaluation({options.named.front()}),
                                  "for the evaluation of " + text::one_line(options.named.front()), work);
            }};
    if (!options.trust.empty()) {
        checks.trusted = signing::read_trust_store(options.trust);
    }
    archive::CheckedDraft checked =
        archive::checked_draft(options.named.front(), {options.named.begin() + 1, options.named.end()}, checks);
    progress.clear();
    archive::Request request = request_of(options);
    const certificate::CertificateData data = archive::stated_identity(checked.record);
    if (data.amendment.has_value() != is_amendment) {
        refuse_usage(options.named.front(), is_amendment ? "amends no certificate" : "amends another certificate",
                     "an amendment comes in by gumcert archive amend, every other certificate by add",
                     is_amendment ? "state the amendment in the certificate data, or use add" : "use amend");
    }
    if (is_amendment) {
        archive::state_amendment(checked, archive.record_of(data.amendment->number));
        if (request.why.empty()) {
            request.why = data.amendment->reason.in(data.languages.empty() ? "en" : data.languages.front());
        }
    }
    print_messages(checked.remarks, common);
    return told(carried_out([&] { return archive.draft(checked.draft, request); }), options, common);
}

ExitCode advance(const ArchiveOptions& options, const CommonOptions& common, const std::string& kind) {
    const auto store = opened(options, archive::Access::read_and_write);
    archive::Archive archive(*store);
    const std::string& number = options.named.front();
    std::vector<gum::Diagnostic> doubts;
    const auto judge = [&](const std::string& record, const archive::CertificateLife& life) {
        if (kind == "reviewed" || kind == "authorised") {
            archive::require_named_person(record, number, kind, options.by);
        } else if (kind == "issued") {
            archive::require_issuable(record, number, today());
            if (!life.authorised_by.empty()) {
                archive::require_named_person(record, number, "authorised", life.authorised_by);
            }
        }
        doubts = archive::doubts_about_days(record, number, kind, today());
    };
    const archive::Written written =
        carried_out([&] { return archive.advance(number, kind, request_of(options), judge); });
    print_messages(doubts, common);
    return told(written, options, common);
}

}  // namespace

ExitCode take_number(const ArchiveOptions& options, const CommonOptions& common) {
    const auto store = opened(options, archive::Access::read_and_write);
    archive::Archive archive(*store);
    const archive::Written written = carried_out([&] {
        return options.amend.empty() ? archive.take_number(request_of(options))
                                     : archive.take_amendment_number(options.amend, request_of(options));
    });
    if (common.quiet && !as_json(options)) {  // the number is the answer
        write_to_stdout(written.entry.certificate + "\n");
    }
    return told(written, options, common);
}

ExitCode add_certificate(const ArchiveOptions& options, const CommonOptions& common) {
    return add_draft(options, common, false);
}

ExitCode amend_certificate(const ArchiveOptions& options, const CommonOptions& common) {
    return add_draft(options, common, true);
}

ExitCode review_certificate(const ArchiveOptions& options, const CommonOptions& common) {
    return advance(options, common, "reviewed");
}

ExitCode authorise_certificate(const ArchiveOptions& options, const CommonOptions& common) {
    return advance(options, common, "authorised");
}

ExitCode issue_certificate(const ArchiveOptions& options, const CommonOptions& common) {
    return advance(options, common, "issued");
}

ExitCode withdraw_certificate(const ArchiveOptions& options, const CommonOptions& common) {
    return advance(options, common, "withdrawn");
}

}  // namespace gumcert::cli
