// Files of a page, embedded in the program.
    .section .rodata

    .global lumel_page_frame, lumel_page_frame_end
lumel_page_frame:
    .incbin LUMEL_PAGE_FRAME
lumel_page_frame_end:

    .global lumel_page_style, lumel_page_style_end
lumel_page_style:
    .incbin LUMEL_PAGE_STYLE
lumel_page_style_end:

    .global lumel_page_viewer, lumel_page_viewer_end
lumel_page_viewer:
    .incbin LUMEL_PAGE_VIEWER
lumel_page_viewer_end:

    .section .note.GNU-stack, "", %progbits
