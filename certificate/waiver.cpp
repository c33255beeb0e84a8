#include "certificate/waiver.h"

#include "certificate/stated_text.h"

namespace gumcert::certificate {

bool has_effect(const Waiver& waiver, const std::string& issued) {
    const bool dated_later = !issued.empty() && waiver.date > issued;
    return is_name(waiver.by) && is_statement(waiver.reason) && !waiver.date.empty() && !dated_later;
}

}  // namespace gumcert::certificate
