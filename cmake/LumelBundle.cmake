# The relocatable release archive: target `bundle`.
