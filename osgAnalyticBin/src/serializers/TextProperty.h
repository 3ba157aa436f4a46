// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

// osg::Object is a virtual base of every callback; OSG's serializer templates read this where they are included.
#undef OBJECT_CAST
#define OBJECT_CAST dynamic_cast

#include <osgDB/InputStream>
#include <osgDB/ObjectWrapper>
#include <osgDB/OutputStream>

#include <string>

/// Defines the three functions that ADD_USER_SERIALIZER(name) asks for, over the get<name>Text() / set<name>Text() pair
/// of a class. Everything is stored as text: OSG writes doubles with six digits into .osgt, which would move a bin by
/// hundreds of metres.
#define OSGANALYTICBIN_TEXT_PROPERTY(type, name)                           \
    static bool check##name(const type& object) {                          \
        return !object.get##name##Text().empty();                          \
    }                                                                      \
    static bool read##name(osgDB::InputStream& is, type& object) {         \
        std::string text;                                                  \
        is.readWrappedString(text);                                        \
        object.set##name##Text(text);                                      \
        return true;                                                       \
    }                                                                      \
    static bool write##name(osgDB::OutputStream& os, const type& object) { \
        os.writeWrappedString(object.get##name##Text());                   \
        os << std::endl;                                                   \
        return true;                                                       \
    }
