#include "reports/dcc/content_model.h"

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <utility>

#include "reports/dcc/xml_document.h"

namespace gumcert::reports {

bool ContentModel::knows(std::string_view element) const {
    return std::any_of(places.begin(), places.end(), [&](const Place& p) { return p.element == element; });
}

namespace {

/// A part of a model: where it begins and ends, and whether it may be left out.
struct Part {
    std::set<std::size_t> first, last;
    bool may_be_empty = false;
};

/// Reads the children of one type. A part that the version does not have is nothing.
class ModelReader {
public:
    /// \param space  of elements whose name has none: "dcc:" or "si:"
    ModelReader(std::string_view text, std::string_view space, int version)
        : rest_(text), space_(space), version_(version) {}

    ContentModel model() {
        std::optional<Part> whole = alternatives();
        while (take('&')) {
            model_.any_order = true;
            (void)alternatives();
        }
        if (!rest_.empty()) {
            throw std::invalid_argument("facts of the schema: " + std::string(rest_));
        }
        if (whole) {
            model_.first = std::move(whole->first);
            model_.last = std::move(whole->last);
            model_.may_be_empty = whole->may_be_empty;
        }
        return std::move(model_);
    }

private:
    bool take(char c) {
        rest_.remove_prefix(std::min(rest_.find_first_not_of(' '), rest_.size()));
        const bool here = rest_.starts_with(c);
        rest_.remove_prefix(here ? 1 : 0);
        return here;
    }

    std::string_view word() {
        const std::size_t end = std::min(rest_.find_first_of(" ?*+@|&()[]"), rest_.size());
        const std::string_view found = rest_.substr(0, end);
        if (found.empty()) {
            throw std::invalid_argument("facts of the schema: " + std::string(rest_));
        }
        rest_.remove_prefix(end);
        return found;
    }

    std::optional<Part> alternatives();
    std::optional<Part> sequence();
    std::optional<Part> term();
    std::optional<Part> element();
    std::optional<Part> with_suffixes(std::optional<Part> part, std::size_t begin);

    std::string_view rest_, space_;
    int version_;
    ContentModel model_;
};

std::optional<Part> ModelReader::alternatives() {
    const std::size_t begin = model_.places.size();
    std::optional<Part> all = sequence();
    bool several = false;
    while (take('|')) {
        const std::optional<Part> other = sequence();
        several = several || (all && other);
        if (all && other) {
            all->first.insert(other->first.begin(), other->first.end());
            all->last.insert(other->last.begin(), other->last.end());
            all->may_be_empty = all->may_be_empty || other->may_be_empty;
        } else if (other) {
            all = other;
        }
    }
    // Where one of several parts is enough, none of their elements can be missing by itself.
    for (std::size_t i = begin; several && i < model_.places.size(); ++i) {
        model_.places[i].required = false;
    }
    return all;
}

std::optional<Part> ModelReader::sequence() {
    std::optional<Part> all;
    const auto at_end = [&] {
        rest_.remove_prefix(std::min(rest_.find_first_not_of(' '), rest_.size()));
        return rest_.empty() || rest_.front() == '|' || rest_.front() == '&' || rest_.front() == ')';
    };
    while (!at_end()) {
        const std::optional<Part> one = term();
        if (!all || !one) {
            all = all ? all : one;
            continue;
        }
        // For each place the ones that may follow it are worked out here, once for a version. So a document is checked
        // in one pass over its children, without going back, whatever its length.
        for (const std::size_t end : all->last) {
            model_.places[end].next.insert(one->first.begin(), one->first.end());
        }
        // What may be left out hides neither beginning nor end: behind an optional first part the second one may begin,
        // and before an optional last part the one before may end.
        if (all->may_be_empty) {
            all->first.insert(one->first.begin(), one->first.end());
        }
        if (!one->may_be_empty) {
            all->last.clear();
        }
        all->last.insert(one->last.begin(), one->last.end());
        all->may_be_empty = all->may_be_empty && one->may_be_empty;
    }
    return all;
}

std::optional<Part> ModelReader::term() {
    const std::size_t begin = model_.places.size();
    if (!take('(')) {
        return with_suffixes(element(), begin);
    }
    const std::optional<Part> inner = alternatives();
    if (!take(')')) {
        throw std::invalid_argument("facts of the schema: a parenthesis is open");
    }
    return with_suffixes(inner, begin);
}

/// "name:text", "valueXMLList:decimal[]", "si:real"
std::optional<Part> ModelReader::element() {
    const std::string whole(word());
    const std::string head = whole.substr(0, whole.find(':'));
    const std::string tail = whole.substr(std::min(whole.find(':') + 1, whole.size()));
    ContentModel::Place place{.element = std::string(space_) + head, .type = tail, .required = true, .next = {}};
    if (head == "si" || head == "ds") {
        place.element = whole;
        place.type = head == "si" ? "si." + tail : "anything";
    }
    if (rest_.starts_with("[]")) {
        place.list = true;
        rest_.remove_prefix(2);
    }
    model_.places.push_back(std::move(place));
    const std::size_t at = model_.places.size() - 1;
    return Part{.first = {at}, .last = {at}};
}

/// ?, *, + and the versions, in this order.
/// \param begin  the first place of the part
std::optional<Part> ModelReader::with_suffixes(std::optional<Part> part, std::size_t begin) {
    const char sign = rest_.empty() ? ' ' : rest_.front();
    const bool optional = sign == '?' || sign == '*';
    const bool repeated = sign == '*' || sign == '+';
    rest_.remove_prefix(optional || repeated ? 1 : 0);
    if (part && repeated) {
        for (const std::size_t end : part->last) {
            model_.places[end].next.insert(part->first.begin(), part->first.end());
        }
    }
    if (part && optional) {
        part->may_be_empty = true;
        for (std::size_t i = begin; i < model_.places.size(); ++i) {
            model_.places[i].required = false;
        }
    }
    if (rest_.starts_with('@')) {
        rest_.remove_prefix(1);
        int limit = 0;
        const auto [end, failure] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), limit);
        rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
        // The places go away with the part: otherwise an element of another version would be known, but "at the wrong
        // place".
        if (limit > 0 ? version_ < limit : version_ > -limit) {
            model_.places.resize(begin);
            return std::nullopt;
        }
    }
    return part;
}

int version_from(std::string_view text) {
    int version = 0;
    std::from_chars(text.data(), text.data() + text.size(), version);
    return version;
}

/// "id refId@330 schemaVersion!" of one version.
std::vector<ElementType::Attribute> attributes_from(std::string_view text, int version) {
    std::vector<ElementType::Attribute> attributes;
    for (const std::string& word : xml_list(text)) {
        const std::size_t at = word.find('@');
        const bool known = at == std::string::npos || version >= version_from(std::string_view(word).substr(at + 1));
        const std::string name = word.substr(0, at);
        const bool required = name.ends_with('!');
        if (known) {
            attributes.push_back({.name = name.substr(0, name.size() - (required ? 1 : 0)), .required = required});
        }
    }
    return attributes;
}

void add_type(std::string_view line, int version, ElementTypes& types) {
    const std::size_t sign = line.find_first_of("=~");
    if (sign == std::string_view::npos) {
        throw std::invalid_argument("facts of the schema: " + std::string(line));
    }
    const std::string_view head = line.substr(0, sign);
    const std::string name = xml_list(head).front();
    ElementType type;
    if (const std::size_t open = head.find('['); open != std::string_view::npos) {
        type.attributes = attributes_from(head.substr(open + 1, head.find(']') - open - 1), version);
    }
    const std::string_view rest = line.substr(sign + 1);
    if (line[sign] == '~') {
        type.words = xml_list(rest);
    } else {
        type.children = ModelReader(rest, name.starts_with("si.") ? "si:" : "dcc:", version).model();
    }
    types.emplace(name, std::move(type));
}

}  // namespace

ElementTypes element_types(std::string_view facts, int version) {
    ElementTypes types;
    std::string line;
    const auto finish = [&] {
        if (!line.empty()) {
            add_type(line, version, types);
        }
        line.clear();
    };
    while (!facts.empty()) {
        const std::size_t end = std::min(facts.find('\n'), facts.size());
        const std::string_view piece = facts.substr(0, end);
        if (!piece.starts_with(' ')) {
            finish();
        }
        line += piece;
        facts.remove_prefix(std::min(end + 1, facts.size()));
    }
    finish();
    return types;
}

}  // namespace gumcert::reports
