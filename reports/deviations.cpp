#include "reports/deviations.h"

#include "certificate/waiver.h"

namespace gumcert::reports {

std::vector<Text> deviations_in_words(const Wording& words, const certificate::CertificateData& data) {
    std::vector<Text> deviations;
    for (const certificate::LocalisedText& deviation : data.method.deviations) {
        deviations.push_back(words.localised(deviation));
    }
    for (const certificate::Waiver& waiver : data.waivers) {
        if (certificate::has_effect(waiver, data.dates.issued)) {
            const Text accepted = words.filled("certificate", "waiver",
                                               {{"finding", waiver.finding}, {"by", waiver.by}, {"date", waiver.date}});
            deviations.push_back(accepted + ": " + words.localised(waiver.reason));
        }
    }
    return deviations;
}

}  // namespace gumcert::reports
