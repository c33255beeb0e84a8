#include "certificate/address_lines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gumcert::certificate {
namespace {

using testing::ElementsAre;

TEST(AddressLines, GivesLinesAsTheyAre) {
    EXPECT_THAT(address_lines({.lines = {"Example Street 1", "12345 Example Town"}, .country = "US"}),
                ElementsAre("Example Street 1", "12345 Example Town"));
    EXPECT_TRUE(address_lines({}).empty());
    EXPECT_TRUE(address_lines({.country = "DE"}).empty()) << "a country alone is no address";
}

TEST(AddressLines, PutsNamedPartsIntoTheOrderOfTheCountry) {
    Address address;
    address.lines = {"Building 5"};
    address.country = "DE";
    address.street = "Musterstraße";
    address.street_no = "1a";
    address.post_office_box = "Postfach 7";
    address.postcode = "12345";
    address.city = "Musterstadt";
    address.state = "Sachsen";
    EXPECT_THAT(address_lines(address),
                ElementsAre("Building 5", "Musterstraße 1a", "Postfach 7", "12345 Musterstadt, Sachsen"));
    address.country = "US";
    EXPECT_THAT(address_lines(address),
                ElementsAre("Building 5", "1a Musterstraße", "Postfach 7", "Musterstadt, Sachsen 12345"));
}

TEST(AddressLines, LeavesOutWhatIsNotStated) {
    Address address;
    address.city = "Musterstadt";
    EXPECT_THAT(address_lines(address), ElementsAre("Musterstadt"));
    address.street_no = "1";
    EXPECT_THAT(address_lines(address), ElementsAre("1", "Musterstadt"));
    address.city.clear();
    address.state = "Sachsen";
    EXPECT_THAT(address_lines(address), ElementsAre("1", "Sachsen"));
}

}  // namespace
}  // namespace gumcert::certificate
