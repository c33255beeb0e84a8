// Strings and lists for tests that are not optimised: what support/optimised_templates.cpp has compiled is not compiled
// once more.
#pragma once

#include_next <gtest/gtest.h>

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

extern template class std::basic_string<char>;
extern template class std::vector<char>;
extern template class std::vector<double>;
extern template class std::vector<std::size_t>;
extern template class std::vector<std::string>;
extern template class std::vector<std::pair<std::string, std::string>>;
extern template class std::set<std::string>;
extern template class std::map<std::string, std::string>;
