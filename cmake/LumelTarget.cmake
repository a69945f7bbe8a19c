# The rooms and who may use whom, ground floor first; tools/lint holds every #include to the same table.
set(LUMEL_ROOM_TABLE ${PROJECT_SOURCE_DIR}/src/rooms.txt)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${LUMEL_ROOM_TABLE})

# lumel_rooms(<result>): the rooms of src.
function(lumel_rooms result)
    file(STRINGS ${LUMEL_ROOM_TABLE} rooms REGEX "^src/[a-z]+:")
    list(TRANSFORM rooms REPLACE "^src/([a-z]+):.*" "\\1")
    set(${result} ${rooms} PARENT_SCOPE)
endfunction()

# lumel_uses(<room> <result>): what the room or a file of it may use.
function(lumel_uses room result)
    file(STRINGS ${LUMEL_ROOM_TABLE} uses REGEX "^src/${room}[/:]")
    list(TRANSFORM uses REPLACE "^[^:]*: *" "")
    list(JOIN uses " " uses)
    separate_arguments(uses)
    set(${result} ${uses} PARENT_SCOPE)
endfunction()

# lumel_room(<name> SOURCES … SYSTEM <library> …): one folder of src as one static library.
function(lumel_room name)
    cmake_parse_arguments(ROOM "" "" "SOURCES;SYSTEM" ${ARGN})
    add_library(lumel_${name} STATIC ${ROOM_SOURCES})
    lumel_flags(lumel_${name})
    lumel_uses(${name} used)
    list(TRANSFORM used PREPEND lumel_)
    target_link_libraries(lumel_${name} PUBLIC ${used} PRIVATE ${ROOM_SYSTEM})
endfunction()

# lumel_test(<name> [TOGETHER] SOURCES … USES <room> …): one GoogleTest program under tests/. Each of its
# tests is a process of its own; TOGETHER: one for all, where they share what takes long to make.
function(lumel_test name)
    cmake_parse_arguments(TEST "TOGETHER" "" "SOURCES;USES;SYSTEM" ${ARGN})
    add_executable(${name} ${TEST_SOURCES})
    lumel_flags(${name} HEADERS lumel_test_headers)
    foreach(used ${TEST_USES})
        target_link_libraries(${name} PRIVATE lumel_${used})
    endforeach()
    target_link_libraries(${name} PRIVATE ${TEST_SYSTEM} lumel_test_support GTest::gtest GTest::gtest_main)
    if(TEST_TOGETHER)
        add_test(NAME ${name} COMMAND ${name})
        # The longest test begins first, or a processor idles while it ends.
        set_tests_properties(${name} PROPERTIES TIMEOUT 1500 COST 1500)
    else()
        gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST PROPERTIES TIMEOUT 900)
    endif()
endfunction()
