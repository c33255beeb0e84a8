#include "laboratory/outlook.h"

#include <optional>
#include <vector>

#include "certificate/dates.h"
#include "gum/quantity/diagnostic.h"
#include "laboratory/recalibration.h"
#include "text/numbers.h"

namespace gumcert::laboratory {

namespace {

/// What tells a line from the others of its certificate.
std::string line_in_words(const CalibrationResult& line) {
    std::string words;
    const std::string nominal = line.nominal ? text::shortest_plain(*line.nominal) + " " +
                                                   (line.nominal_unit.empty() ? line.unit : line.nominal_unit)
                                             : "";
    for (const std::string& word : {line.quantity, line.range, line.mode, nominal}) {
        words += (words.empty() || word.empty() ? "" : ", ") + word;
    }
    return words;
}

/// The record as it was on the day of one of its calibrations, and counters up to a day.
StandardRecord up_to(const StandardRecord& record, const Calibration& last, std::string_view day) {
    StandardRecord then = record;
    const auto behind = (&last - record.calibrations.data()) + 1;
    // A question about a past day is answered with what was known on that day.
    then.calibrations.erase(then.calibrations.begin() + behind, then.calibrations.end());
    if (then.interval) {
        std::erase_if(then.interval->readings,
                      [&](const UsageReading& reading) { return certificate::is_after(reading.date, day); });
    }
    return then;
}

void propose(CalibrationOutlook& out, const StandardRecord& record, std::string_view day) {
    if (!record.interval) {
        out.why = "the register states no plan of recalibration";
        return;
    }
    if (out.last != &record.calibrations.back() && record.interval->method != IntervalMethod::control_chart) {
        out.why = "the numbers of its plan belong to a later calibration";
        return;
    }
    const StandardRecord then = up_to(record, *out.last, day);
    const std::vector<CalibrationResult>& lines = then.calibrations.back().results;
    std::size_t silent = 0;
    std::string trouble;
    for (const CalibrationResult& line : lines) {
        std::optional<Recalibration> next;
        try {
            next = next_calibration(then, line);
        } catch (const gum::InputError& error) {
            ++silent;
            trouble = trouble.empty() ? error.diagnostics().front().what : trouble;
            continue;
        }
        // One line that is due makes the whole standard due: it is sent away as a whole.
        const bool is_earlier = !next->due.empty() && (out.next.empty() || certificate::is_after(out.next, next->due));
        if (is_earlier || out.why.empty()) {
            const std::string words = lines.size() > 1 ? line_in_words(line) : "";
            out.next = next->due;
            out.why = next->because + (words.empty() ? "" : " (" + words + ")");
        }
    }
    if (silent > 0) {
        out.why += out.why.empty() ? trouble
                                   : "; nothing can be said of " + std::to_string(silent) + " of " +
                                         std::to_string(lines.size()) + " lines: " + trouble;
    }
}

}  // namespace

CalibrationOutlook calibration_outlook(const StandardRecord& record, std::string_view day) {
    CalibrationOutlook out;
    out.last = calibration_on(record, day);
    if (out.last == nullptr) {
        out.state = CalibrationState::not_calibrated;
        out.because = out.why = "no calibration up to this day";
        return out;
    }
    propose(out, record, day);
    const std::string& valid_to = out.last->valid_to;
    // A laboratory that plans the next calibration has said until when it uses the last one.
    out.last_day = valid_to.empty() ? out.next : valid_to;
    if (certificate::is_after(day, valid_to)) {
        out.state = CalibrationState::overdue;
        out.because = "valid until " + valid_to;
    } else if (certificate::is_after(day, out.next)) {
        out.state = CalibrationState::overdue;
        out.because = "by its plan due on " + out.next;
    } else if (!out.last_day.empty()) {
        out.state = CalibrationState::valid;
    } else {
        out.because = "the register states no last day of use, and no day follows from a plan";
    }
    return out;
}

}  // namespace gumcert::laboratory
