super::doors!(Ltdl);
