/* xml.c: texts of XML that are looked through before assimp reads them. */
#include "check/check.h"

const char *io_xml_local(const char *name) {
    const char *colon = strchr(name, ':');
    return colon ? colon + 1 : name;
}

void io_xml_stop(io_xml *xml, froe_status status) {
    xml->status = status;
    XML_StopParser(xml->parser, XML_FALSE);
}

void io_xml_refuse(io_xml *xml, froe_status status, const char *sentence) {
    io_xml_stop(xml, support_fail(xml->sink->diag, status, "%s: line %lu: %s", support_short(xml->sink->path),
                                  (unsigned long)XML_GetCurrentLineNumber(xml->parser), sentence));
}

/* *whole becomes false where the text has ended in the middle. */
static froe_status parse(io_xml *xml, const formats_text *text, bool *whole) {
    enum { CHUNK = 1 << 20 };
    froe_status status = FROE_OK;
    for (size_t at = 0; at < text->count && *whole && !status; at += CHUNK) {
        const size_t size = text->count - at < CHUNK ? text->count - at : CHUNK;
        *whole = XML_Parse(xml->parser, text->data + at, (int)size, at + size == text->count) != XML_STATUS_ERROR;
        if (!*whole && XML_GetErrorCode(xml->parser) == XML_ERROR_NO_MEMORY)
            status = support_fail_memory(xml->sink->diag);
        if (!status) status = formats_sink_progress(xml->sink, 0);
    }
    return status;
}

froe_status io_xml_look_at(io_xml *xml, const formats_text *text, const io_xml_handlers *handlers, bool *whole) {
    bool good = true;
    xml->parser = XML_ParserCreate(NULL);
    if (!xml->parser) return support_fail_memory(xml->sink->diag);
    XML_SetUserData(xml->parser, xml);
    XML_SetElementHandler(xml->parser, handlers->begin, handlers->end);
    XML_SetCharacterDataHandler(xml->parser, handlers->text);
    const froe_status status = parse(xml, text, &good);
    if (whole)
        *whole = good;
    else if (!status && !xml->status && !good && XML_GetErrorCode(xml->parser) != XML_ERROR_UNKNOWN_ENCODING)
        io_xml_refuse(xml, FROE_E_FORMAT, "The text is not well-formed XML.");
    XML_ParserFree(xml->parser);
    return status ? status : xml->status;
}

froe_status io_xml_look(io_xml *xml, const formats_source *source, const io_xml_handlers *handlers, bool *whole) {
    formats_text text = {0};
    froe_status status = formats_load_part(source, xml->sink, 0, (size_t)source->size, &text);
    if (!status) status = io_xml_look_at(xml, &text, handlers, whole);
    array_free(&xml->sink->alloc, &text);
    return status;
}
