#include "reports/view/decision_formula.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "reports/forms/asset_files.h"
#include "tests/unit/reports/document_text.h"

namespace gumcert::reports {
namespace {

std::string formula(const std::string& recorded, const std::string& language) {
    const nlohmann::json texts =
        nlohmann::json::parse(read_asset(assets().templates / "wording" / (language + ".json")));
    return decision_formula(recorded, Wording(texts)).first();
}

TEST(DecisionFormula, NumbersBelowZeroHaveAMinusSign) {
    EXPECT_EQ(formula("AU = TU − r·U, AL = TL + r·U, r = -0.2", "en"), "A_U = T_U − r·U, A_L = T_L + r·U, r = −0.2");
    EXPECT_EQ(formula("AU = TU − r·U, r = -0.2", "de"), "A_U = T_U − r·U, r = −0,2");
    EXPECT_EQ(formula("r = -1E-5", "en"), "r = −1\u00A0×\u00A010⁻⁵");
}

TEST(DecisionFormula, HasTheDecimalSignOfTheLanguageAndNoHyphen) {
    for (const char* language : {"en", "de", "es", "zh-Hant"}) {
        for (const char* number : {"-0.2", "-12.5", "-0.005", "-3"}) {
            const std::string text = formula(std::string("AU = TU − r·U, r = ") + number + ", if TUR ≥ 4", language);
            EXPECT_EQ(text.find('-'), std::string::npos) << language << ": " << text;
        }
    }
}

}  // namespace
}  // namespace gumcert::reports
