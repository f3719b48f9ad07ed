//! Robot files and expressions to models.
