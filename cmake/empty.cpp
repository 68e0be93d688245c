// A layer that has no sources yet.
