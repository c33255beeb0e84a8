// Compiled as a release and linked first, see tests/CMakeLists.txt.
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

template class std::basic_string<char>;
template class std::vector<char>;
template class std::vector<double>;
template class std::vector<std::string>;
template class nlohmann::basic_json<>;
template class nlohmann::basic_json<nlohmann::ordered_map>;
template class std::vector<nlohmann::json>;
template class std::vector<nlohmann::ordered_json>;
template class std::map<std::string, nlohmann::json, std::less<void>>;

namespace nlohmann::detail {

using Input = decltype(input_adapter(std::declval<const std::string&>()));

template class lexer<json, Input>;
template class lexer<ordered_json, Input>;
template class parser<json, Input>;
template class parser<ordered_json, Input>;
template class serializer<json>;
template class serializer<ordered_json>;

}  // namespace nlohmann::detail
