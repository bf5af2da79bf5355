#include "bench/error_csv.h"

#include <charconv>
#include <functional>
#include <utility>

#include "base/error.h"

namespace triad {
namespace {

std::string quoted(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string out = "\"";
    for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
    return out + "\"";
}

std::string text_of(const std::string& v) { return quoted(v); }
template <class Number>
std::string text_of(Number v) {
    char text[40];
    return {text, std::to_chars(text, text + sizeof text, v).ptr};
}

bool read(std::string_view text, std::string& v) { return v = text, true; }
template <class Number>
bool read(std::string_view text, Number& v) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), v);
    return error == std::errc() && end == text.data() + text.size();
}

struct Column {
    const char* name;
    std::function<std::string(const ErrorRun&)> write;
    std::function<bool(std::string_view, ErrorRun&)> read;
};

template <class Member>
Column column(const char* name, Member member) {
    return {name, [member](const ErrorRun& r) { return text_of(r.*member); },
            [member](std::string_view text, ErrorRun& r) { return read(text, r.*member); }};
}

const std::vector<Column>& columns() {
    static const std::vector<Column> all = {
        column("scene", &ErrorRun::scene),
        column("setting", &ErrorRun::setting),
        column("repetition", &ErrorRun::repetition),
        column("seed", &ErrorRun::seed),
        column("spp", &ErrorRun::spp),
        column("seconds", &ErrorRun::seconds),
        column("rays", &ErrorRun::rays),
        column("mse", &ErrorRun::mse),
        column("relmse", &ErrorRun::relmse),
        column("relmse_trimmed", &ErrorRun::relmse_trimmed),
        column("reference_relmse", &ErrorRun::reference_relmse),
        column("flip", &ErrorRun::flip),
        column("fireflies", &ErrorRun::fireflies),
        column("nan", &ErrorRun::nan),
    };
    return all;
}

/// The fields of the next record; `text` moves on behind it. False: a quote does not end.
bool next_record(std::string_view& text, std::vector<std::string>& fields) {
    fields.assign(1, "");
    bool inside = false;
    std::size_t i = 0;
    for (; i < text.size(); ++i) {
        const char c = text[i];
        if (inside && c == '"' && i + 1 < text.size() && text[i + 1] == '"')
            fields.back() += text[++i];
        else if (c == '"')
            inside = !inside;
        else if (!inside && c == ',')
            fields.emplace_back();
        else if (!inside && c == '\n')
            break;
        else if (inside || c != '\r')
            fields.back() += c;
    }
    text.remove_prefix(std::min(i + 1, text.size()));
    return !inside;
}

}  // namespace

std::string csv_of(std::span<const ErrorRun> runs) {
    std::string text;
    for (const Column& c : columns()) text += (text.empty() ? "" : ",") + std::string(c.name);
    for (const ErrorRun& run : runs) {
        std::string line;
        for (const Column& c : columns()) line += (line.empty() ? "\n" : ",") + c.write(run);
        text += line;
    }
    return text + "\n";
}

std::vector<ErrorRun> runs_from_csv(const std::string& name, std::string_view text) {
    std::vector<std::string> fields;
    std::size_t record = 1;
    const auto bad = [&](const std::string& what) {
        return Error(Exit::scene, name + ", record " + std::to_string(record) + ": " + what +
                                      "; expected a runs.csv of triad bench error.");
    };
    if (!next_record(text, fields)) throw bad("a quote does not end");
    std::vector<std::pair<std::size_t, const Column*>> order;
    for (const Column& c : columns()) {
        std::size_t at = 0;
        while (at < fields.size() && fields[at] != c.name) ++at;
        if (at == fields.size()) throw bad(std::string("there is no column ") + c.name);
        order.emplace_back(at, &c);
    }
    const std::size_t width = fields.size();
    std::vector<ErrorRun> runs;
    while (!text.empty()) {
        ++record;
        if (!next_record(text, fields)) throw bad("a quote does not end");
        if (fields.size() != width)
            throw bad("it has " + std::to_string(fields.size()) + " fields instead of " +
                      std::to_string(width));
        ErrorRun& run = runs.emplace_back();
        for (const auto& [at, c] : order)
            if (!c->read(fields[at], run)) throw bad(std::string(c->name) + " is " + fields[at]);
    }
    return runs;
}

}  // namespace triad
